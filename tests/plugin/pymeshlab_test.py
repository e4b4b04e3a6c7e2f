# SPDX-License-Identifier: GPL-3.0-or-later
"""pymeshlab_test.py PLUGINS SOURCE: runs the lines of docs/pymeshlab.md as they stand there, and checks
what they leave and what else the page says. PLUGINS were built for PyMeshLab
(WAVEMESH_MESHLAB_SCALAR=double). Exit code 77: skipped."""
import os
import re
import sys
import tempfile

plugins, source = (os.path.abspath(path) if path else '' for path in sys.argv[1:3])
with open(source + '/docs/pymeshlab.md', encoding='utf-8') as page:
    blocks = re.findall(r'^```python\n(.*?)^```$', page.read(), re.DOTALL | re.MULTILINE)
assert len(blocks) == 1, 'the page has one listing'
code = compile(blocks[0], 'docs/pymeshlab.md', 'exec')

try:
    import pymeshlab
except ImportError:
    print('SKIPPED: there is no pymeshlab for', sys.executable)
    sys.exit(77)
if not os.path.exists(plugins + '/libio_wavemesh.so'):
    print('SKIPPED: there are no plugins for PyMeshLab in', plugins or 'a folder that was named')
    sys.exit(77)

sets = []  # PyMeshLab writes to the log of a set on which a filter failed, even when it is gone


def opened(*arguments, **options):
    sets.append(pymeshlab.MeshSet())
    sets[-1].load_new_mesh(*arguments, **options)
    return sets[-1]


def message(kind, call, *arguments, **options):
    """What `call` complains of, as an exception of this kind."""
    try:
        call(*arguments, **options)
    except kind as error:
        return str(error)
    raise AssertionError(f'nothing is wrong with {arguments} {options}')


def check_listing(names):
    whole = opened('samples/pretzel.ply').current_mesh()
    vertices = whole.vertex_number()
    assert 0 < os.path.getsize('pretzel.wmc') < 10 * vertices
    assert names['coarse'] < vertices
    assert names['shown']['level'] == names['shown']['finest_level']
    assert names['shown']['vertices'] == vertices
    assert names['coarse'] < names['reduced']['vertices'] <= vertices / 4
    assert names['ms'].current_mesh().vertex_scalar_array().min() == 0
    assert (names['ms'].current_mesh().vertex_matrix() != whole.vertex_matrix()).any()
    assert names['report']['iii_bpv'] > 0 and names['report']['compact_bpv'] > 0
    with open('curves.csv', encoding='utf-8') as table:
        assert any('III' in row for row in table)
    assert os.path.getsize('curves.svg') > 1000


def check_saving():
    ms = opened('samples/pretzel.ply')
    sizes = []
    for options in ({'bits': 8}, {}, {'mode': 'classic'}, {'exact': True}):
        ms.save_current_mesh('saved.wmc', **options)
        sizes.append(os.path.getsize('saved.wmc'))
    assert sizes == sorted(set(sizes)), sizes
    ms.save_current_mesh('saved.wmc', mode=0)
    assert os.path.getsize('saved.wmc') == sizes[2]
    assert ms.filter_parameter_values('wmc')['bits'] == 12

    # One that no float holds.
    corners = opened('samples/pretzel.ply').current_mesh()
    matrix = corners.vertex_matrix() + 1e6 / 3
    ms.add_mesh(pymeshlab.Mesh(vertex_matrix=matrix, face_matrix=corners.face_matrix()))
    ms.save_current_mesh('exact.wmc', exact=True, keep_order=True)
    assert (opened('exact.wmc').current_mesh().vertex_matrix() == matrix).all()

    vase = opened('samples/vase.ply')
    for kept in (True, False):
        vase.save_current_mesh('vase.wmc', save_vertex_color=kept)
        assert opened('vase.wmc').current_mesh().has_vertex_color() == kept


def check_levels():
    ms = opened('pretzel.wmc', all_levels=True)
    finest = ms.apply_filter('apply_wavemesh_level')['finest_level']
    assert ms.mesh_number() == finest + 1
    assert len(opened('pretzel.wmc', max_bytes=2000).current_mesh().vertex_matrix()) < 4547

    ms = opened('pretzel.wmc')
    assert ms.apply_filter('apply_wavemesh_level', level=-1)['level'] == 0
    made = ms.apply_filter('generate_wavemesh_levels', first=2, last=4)
    assert (made['first'], made['last'], made['layers']) == (2, 4, 3)
    assert ms.mesh_number() == 4

    moves = [opened('samples/pretzel.ply').apply_filter(
        'apply_coord_wavemesh_equaliser', **gains)['largest_move']
        for gains in ({'band_1': 2}, {'band_1': 50}, {'gains': '50'})]
    assert moves[0] == moves[1] < moves[2]


def check_errors():
    error = pymeshlab.PyMeshLabException
    with open('pretzel.wmc', 'rb') as file:
        stream = file.read()
    for name, content in ('cut', stream[:3000]), ('head', stream[:10]), ('other', b'ply\n' * 9):
        with open(name + '.wmc', 'wb') as file:
            file.write(content)
    assert re.search(r'\(level \d+ of \d+\)', opened('cut.wmc').current_mesh().label())
    ms = opened('samples/pretzel.ply')
    assert 'ends inside its head' in message(error, ms.load_new_mesh, 'head.wmc')
    assert 'not a .wmc file' in message(error, ms.load_new_mesh, 'other.wmc')
    assert 'missing.wmc' in message(error, ms.load_new_mesh, 'missing.wmc')
    assert 'levl' in message(error, ms.load_new_mesh, 'pretzel.wmc', levl=3)
    assert '1 to 24' in message(error, ms.save_current_mesh, 'saved.wmc', bits=99)
    assert 'no/such' in message(error, ms.save_current_mesh, 'no/such/saved.wmc')
    choice = pymeshlab.InvalidEnumException
    assert 'compact' in message(choice, ms.save_current_mesh, 'saved.wmc', mode='klassic')
    message(RuntimeError, ms.save_current_mesh, 'saved.wmc', bits='twelve')
    equalise = 'apply_coord_wavemesh_equaliser'
    assert "'x'" in message(error, ms.apply_filter, equalise, gains='x')
    assert '.svg' in message(error, ms.apply_filter, 'get_wavemesh_report', samples=100,
                             picture='curves.png')
    assert ms.mesh_number() == 1


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)  # a clone as the page has it
    os.mkdir('build-py')
    os.symlink(plugins, 'build-py/plugins')
    os.symlink(source + '/samples', 'samples')
    listing = {}
    exec(code, listing)
    check_listing(listing)
    check_saving()
    check_levels()
    check_errors()
