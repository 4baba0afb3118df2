# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Well-formed results with damaged arrays: they are judged, or refused by name."""
from command_helpers import *

OCTAHEDRON = ([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)],
              [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)])


class DamagedFiles(CommandTest):
    def test_wrong_cones_without_vertex_numbers(self):
        mesh, result = self.write('o.obj', obj_text(*OCTAHEDRON)), self.path('map.vtu')
        self.run_ok('seamless', mesh, '-o', result, '--degree', '1', '--quiet')
        file = Vtu(result)
        file.arrays['cone'] = [7] * len(file.arrays['cone'])
        file.write(result)
        numbers = r'<DataArray type="Int32" Name="input_vertex".*?</DataArray>\n'
        self.write('map.vtu', re.sub(numbers, '', self.read('map.vtu').decode(), flags=re.S))
        self.found(result, says='marked as a cone of 7 quarter turns')
        self.found(result, '--surface', mesh, says='marked as a cone of 7')

    def test_a_vertex_number_twice_that_is_no_cut(self):
        mesh, result = self.write('g.obj', obj_text(*grid(2))), self.path('map.vtu')
        self.run_ok('parametrize', mesh, '-o', result, '--degree', '2', '--quiet')
        file = Vtu(result)
        numbers = file.arrays['input_vertex']
        numbers[numbers.index(-1)] = numbers[0]  # the vertex of a point inside an edge
        file.write(result)
        self.run_ok('convert', result, '-o', self.path('out.vtu'), '-o', self.path('out.svg'))
        self.assertEqual(Vtu(self.path('out.vtu')).arrays['uv'], file.arrays['uv'])

    def test_a_grid_far_from_the_origin(self):
        """Between grid lines that far away there are no integers among the doubles."""
        far, near = 10**17, 10**17 + 640
        places = [(far, far), (near, far), (far, near)]
        mesh = self.write('far.obj', obj_text([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], places))
        self.run_ok('convert', mesh, '-o', self.path('far.svg'), '--grid', '4')
        paths = re.findall(r' d="([^"]*)"', self.read('far.svg').decode())
        self.assertIn(2 * (640 // 4 + 1), [path.lower().count('m') for path in paths])


if __name__ == '__main__':
    main()
