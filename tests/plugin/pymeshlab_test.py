# SPDX-License-Identifier: GPL-3.0-or-later
"""pymeshlab_test.py PLUGINS SAMPLES: the lines of docs/pymeshlab.md, checked. PLUGINS were built for
PyMeshLab (WAVEMESH_MESHLAB_SCALAR=double). Exit code 77: skipped."""
import os
import sys
import tempfile

try:
    import pymeshlab
except ImportError:
    print('SKIPPED: there is no pymeshlab for', sys.executable)
    sys.exit(77)

plugins, samples = sys.argv[1:3]
if not os.path.exists(plugins + '/libio_wavemesh.so'):
    print('SKIPPED: there are no plugins for PyMeshLab in', plugins)
    sys.exit(77)
for name in ('io_wavemesh', 'filter_wavemesh'):
    pymeshlab.load_plugin(f'{plugins}/lib{name}.so')

with tempfile.TemporaryDirectory() as folder:
    wmc = folder + '/pretzel.wmc'
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(samples + '/pretzel.ply')
    whole = ms.current_mesh().vertex_number()
    ms.save_current_mesh(wmc, bits=12)
    assert 0 < os.path.getsize(wmc) < 10 * whole

    ms.load_new_mesh(wmc, level=3)
    assert ms.current_mesh().vertex_number() < whole
    shown = ms.apply_filter('apply_wavemesh_level', level=-1)
    assert shown['level'] == shown['finest_level']
    assert ms.current_mesh().vertex_number() == whole
    ms.apply_filter('meshing_decimation_wavemesh', target='percentage', percentage=25)
    assert ms.current_mesh().vertex_number() <= whole / 4

    ms.load_new_mesh(samples + '/pretzel.ply')
    before = ms.current_mesh().vertex_matrix().copy()
    ms.apply_filter('compute_scalar_by_wavemesh_detail_per_vertex', measure='level of birth')
    assert ms.current_mesh().vertex_scalar_array().min() == 0
    ms.apply_filter('apply_coord_wavemesh_equaliser')
    assert (ms.current_mesh().vertex_matrix() == before).all()
    ms.apply_filter('apply_coord_wavemesh_equaliser', band_5=0, threshold=0.1)
    assert (ms.current_mesh().vertex_matrix() != before).any()
    report = ms.apply_filter('get_wavemesh_report', samples=1000, picture=folder + '/curves.svg')
    assert report['iii_bpv'] > 0 and 'III' in report['csv']
    assert os.path.getsize(folder + '/curves.svg') > 1000
