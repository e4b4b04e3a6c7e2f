# SPDX-License-Identifier: GPL-3.0-or-later
"""pymeshlab_test.py PLUGINS SOURCE: runs the lines of docs/pymeshlab.md as they stand there, and checks
what they leave. PLUGINS were built for PyMeshLab (WAVEMESH_MESHLAB_SCALAR=double). Exit code 77: skipped."""
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

with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)  # a clone as the page has it
    os.mkdir('build-py')
    os.symlink(plugins, 'build-py/plugins')
    os.symlink(source + '/samples', 'samples')
    names = {}
    exec(code, names)

    whole = pymeshlab.MeshSet()
    whole.load_new_mesh('samples/pretzel.ply')
    vertices = whole.current_mesh().vertex_number()
    assert 0 < os.path.getsize('pretzel.wmc') < 10 * vertices
    assert names['coarse'] < vertices
    assert names['shown']['level'] == names['shown']['finest_level']
    assert names['shown']['vertices'] == vertices
    assert names['reduced']['vertices'] <= vertices / 4
    assert names['ms'].current_mesh().vertex_scalar_array().min() == 0
    assert (names['ms'].current_mesh().vertex_matrix() != whole.current_mesh().vertex_matrix()).any()
    assert names['report']['iii_bpv'] > 0 and 'III' in names['report']['csv']
    assert os.path.getsize('curves.svg') > 1000
