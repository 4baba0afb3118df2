# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Options without effect are refused with a remedy; every option of --help has a row here."""
import re

from command_helpers import *

MAPS = ['parametrize', 'unwrap', 'seamless', 'deform']

# Options that always have an effect, with the reason if it is not obvious.
ALWAYS = {
    '--help': '', '--version': '', '--output': '', '--report': '', '--distortion': 'a file of its own',
    '--force': 'a permission', '--strict': 'a demand', '--quiet': '', '--verbose': 'steps, of whatever has some',
    '--threads': 'results do not depend on it', '--degree': '', '--energy': '', '--pins': '', '--handles': '',
    '--weights': '', '--boundary-angles': 'a demand', '--quadrature': 'the rule, whatever the degree',
    '--boundary': '', '--curvature': '', '--effort': 'the paths',
    '--elevation': 'the way to the degree, also to the first',
    '--bijective': '', '--improve-mesh': 'depends on the mesh', '--tolerance': '', '--max-iterations': '',
    '--time-limit': '', '--normalize': '', '--scale': '', '--linear-solver': '', '--seams': '', '--no-pack': '', '--weld': '',
    '--upright': '', '--udim': '', '--texel-density': '', '--stack': '', '--stacked': 'a permission',
    '--objects': '',
    '--from': '', '--attribute': '', '--method': '', '--distance': 'a demand', '--samples': '', '--filter': '',
    '--depth': '', '--linear': '',
    '--charts': 'auto demands nothing of --seams uv and FILE', '--preset': 'padding and resolution',
    '--cones': '', '--start': '', '--surface': '', '--cuts': '', '--certify': '', '--plan': '', '--methods': '',
    '--petsc-options': 'for whichever solver a run comes to',
    '--linear-solvers': 'measures them', '--list': '', '--quads': '', '--features': '',
    '--count': '', '--edge-length': '', '--target': '', '--msh-version': '', '--binary': '',
}

# option -> (words without effect, outputs, message), for every verb with the option
CASES = {
    '--format': (['--format', 'obj'], ['.vtu'], 'no file is -'),
    '--soft': (['--soft', '10'], ['.vtu'], '--soft requires --handles'),
    '--no-flips': (['--no-flips'], ['.vtu'], '--no-flips needs --bijective'),
    '--write-scaffold': (['--write-scaffold', 's.vtu'], ['.vtu'], '--write-scaffold needs --bijective'),
    '--snapshots': (['--snapshots', '2'], ['.vtu'], 'add -o OUT.html'),
    '--refine': (['--refine', '2'], ['.vtu', '.svg'], 'add -o OUT.obj'),
    '--vtu': (['--vtu', 'lagrange'], ['.obj', '.html'], 'add -o OUT.vtu'),
    '--msh': (['--msh', 'surface'], ['.vtu'], 'add -o OUT.msh'),
    '--grid': (['--grid', '0.1'], ['.vtu', '.html'], 'add -o OUT.svg'),
    '--squares': (['--squares', '9'], ['.png'], '--squares requires --view'),
    '--view': (['--view', '1,0,0'], ['.svg'], 'add -o OUT.png'),
    '--resolution': (['--no-pack', '--resolution', '300'], ['.vtu'], '--resolution excludes --no-pack'),
    '--keep-shape': (['--keep-shape'], ['.obj'], 'add --seams uv'),
    '--groups': (['--groups'], ['.vtu'], 'add -o OUT.obj'),
    '--keep-seams': (['--seams', 'uv', '--keep-seams'], ['.vtu'], '--seams uv cuts along them already'),
    '--uv-set': (['--uv-set', '1'], ['.vtu'], 'add -o OUT.glb'),
    '--fill': (['--charts', 'one', '--fill', '0.5'], ['.vtu'], '--charts one leaves them'),
    '--hide-from': (['--seams', 'FILE', '--hide-from', '1,0,0'], ['.vtu'], '--seams FILE says where'),
    '--curvature-alignment': (['--cones', 'FILE', '--curvature-alignment', '9'], ['.vtu'],
                              '--cones excludes --curvature-alignment'),
}
PICTURED = ['parametrize', 'unwrap', 'seamless', 'deform', 'convert']


def of_drawings(*words, outputs):
    return {**{verb: (words, outputs, 'add -o OUT.svg') for verb in PICTURED},
            'compare': (words, [], words[0] + ' applies to two results side by side')}


# option -> verb -> (words without effect, outputs, message)
OF_VERBS = {
    '--edges': of_drawings('--edges', 'no', outputs=['.vtu', '.html']),
    '--legend': of_drawings('--legend', 'no', outputs=['.vtu', '.html']),
    '--color-range': of_drawings('--color-range', '4,5', outputs=['.vtu']),
    '--color-by': of_drawings('--color-by', 'area', outputs=['.vtu']),
    '--transparent': of_drawings('--transparent', outputs=['.vtu', '.html']),
    '--border-corners': {'check': (['--border-corners', '90'], [], 'applies to quad meshes'), 'quads': None},
    '--max-distance': {'check': (['--max-distance', '0.1'], [], 'applies to quad meshes')},
    '--bake': {'unwrap': (['--bake'], ['.vtu'], '-o OUT.obj')},
    '--size': {**of_drawings('--size', '99,99', outputs=['.vtu']), 'bake': None},
    '--image': {**{verb: (['--image', 'PICTURE'], ['.svg'], 'add -o OUT.png') for verb in PICTURED}, 'bake': None},
    '--padding': {'unwrap': (['--no-pack', '--padding', '3'], ['.vtu'], '--padding excludes --no-pack'), 'bake': None},
    '--align': {**{verb: (['--align'], ['.csv'], 'add -o OUT.vtu') for verb in ('parametrize', 'seamless', 'deform')},
                'unwrap': (['--align'], ['.json'], 'add -o OUT.vtu'), 'convert': None},  # convert writes only maps
    '--init': {'parametrize': (['--seamless', '--init', 'tutte'], ['.vtu'], 'leave out --init tutte'),
               'compare': None},
    '--seamless': {'parametrize': None, 'check': None},
    '--max-stretch': {'parametrize': (['--max-stretch', '2'], ['.vtu'], '--max-stretch requires --seams'),
                      'unwrap': (['--seams', 'FILE', '--max-stretch', '2'], ['.vtu'], '--seams FILE says where')},
}


SOLVED_BY_PETSC = {'parametrize', 'seamless', 'deform'}


def options_of(verb):
    return sorted(set(re.findall(r'^  (?:-\w, )?(--[a-z-]+)', majorant(*verb.split(), '--help').out, re.MULTILINE)))


class OptionsWithoutEffect(CommandTest):
    def case(self, option, verb):
        """Returns (words, outputs, message), or None if the option always has an effect."""
        if option in OF_VERBS:
            return OF_VERBS[option][verb]
        return CASES.get(option)

    def test_every_option_has_a_row(self):
        found = set()
        for verb in verb_names():
            for option in options_of(verb):
                found.add(option)
                self.assertEqual(sum([option in ALWAYS, option in CASES, verb in OF_VERBS.get(option, {})]), 1,
                                 (verb, option))
        self.assertEqual(found, set(ALWAYS) | set(CASES) | set(OF_VERBS))

    def test_petsc_options_of_verbs_without_petsc(self):
        for verb in verb_names():
            with self.subTest(verb=verb):
                self.assertEqual('--petsc-options' in options_of(verb), verb in SOLVED_BY_PETSC)
                if verb not in SOLVED_BY_PETSC:
                    outcome = majorant(*verb.split(), generated('cap'), '--petsc-options', '-info')
                    self.assertEqual(outcome.code, USAGE, outcome.err)
                    self.assertIn('--petsc-options', outcome.err)

    def test_refused_with_a_remedy(self):
        mesh = self.write('flat.obj', obj_text(*grid(3, lambda x, y: 0.0)))
        handles = self.write('h.json', '{"handles": [{"vertex": 0, "target": "initial"}]}')
        self.write('FILE', '{"edges": [[0, 1]], "cones": []}')
        self.run_ok('parametrize', mesh, '-o', self.path('PICTURE.png'), '--quiet', '--degree', 1)
        self.run_ok('parametrize', mesh, '-o', self.path('map.vtu'), '--quiet', '--degree', 1)
        tried = 0
        for verb in verb_names():
            for option in options_of(verb):
                case = self.case(option, verb)
                if case is None:
                    continue
                words, outputs, says = case
                words = [self.path('PICTURE.png') if w == 'PICTURE' else w for w in words]
                run = [*verb.split(), self.path('map.vtu') if verb == 'convert' else mesh, *words]
                run += ['--pins', handles] if verb == 'deform' else []
                for k, extension in enumerate(outputs if verb != 'compare' else ['.csv']):
                    run += ['-o', self.path('out%d%s' % (k, extension))]
                with self.subTest(run=run):
                    tried += 1
                    outcome = majorant(*run, cwd=self.folder)
                    self.assertEqual(outcome.code, USAGE, outcome.err)
                    self.assertEqual(outcome.err.count('\n'), 1, outcome.err)
                    self.assertIn(says, outcome.err)
                    self.assertFalse([f for f in self.files() if f.startswith('out')])
        self.assertGreater(tried, 50)

    def test_options_with_effect_are_accepted(self):
        mesh = generated('cap')
        self.run_ok('parametrize', mesh, '--quiet', '--degree', 2, '-o', self.path('a.vtu'), '-o', self.path('a.obj'),
                    '-o', self.path('a.svg'), '-o', self.path('a.png'), '-o', self.path('a.msh'), '--vtu', 'lagrange',
                    '--msh', 'surface', '--refine', 2, '--grid', 0.1, '--color-range', '0.5,5', '--color-by', 'area',
                    '--size', '400,300', '--view', '1,1,1', '--align', '--transparent')
        self.run_ok('unwrap', mesh, '--quiet', '-o', self.path('b.obj'), '--padding', 2, '--resolution', 512,
                    '--max-stretch', 1.1)
        handles = self.write('h.json', '{"handles": [{"vertex": 0, "target": "initial"}]}')
        self.run_ok('parametrize', mesh, '--quiet', '-o', self.path('c.vtu'), '--handles', handles, '--soft', 10)


if __name__ == '__main__':
    main()
