#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""docs/constants.md: every number that decides results has an origin, and the page says what the
sources say."""
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
sys.path.insert(0, str(SOURCE / 'scripts'))
import constants  # noqa: E402


class TheSources(unittest.TestCase):
    found = constants.all_constants(SOURCE)

    def test_every_number_has_an_origin(self):
        self.assertEqual(list(constants.faults(self.found)), [])
        self.assertGreaterEqual(len(self.found), 100)

    def test_the_page_is_what_the_script_writes(self):
        _, tables, _ = constants.page_parts((SOURCE / constants.PAGE).read_text())
        self.assertEqual(tables, constants.tables(self.found), 'run scripts/constants.py --write')

    def test_commands_exist(self):
        """Scripts of bench/ that origins name, and the rules that they can vary."""
        names = set(re.findall(r'^ +\{"([\w.]+)",', (SOURCE / 'bench/tune.cpp').read_text(), re.M))
        values = set(re.findall(r"^    '([\w.]+)': '", (SOURCE / 'bench/tune.py').read_text(), re.M))
        self.assertGreaterEqual(len(names), 30)
        self.assertLessEqual(values, names)
        varied = 0
        for c in self.found:
            for script, rule in re.findall(r'bench/(\w+\.py) ?([\w.]*\w)?', c.origin):
                self.assertTrue((SOURCE / 'bench' / script).exists(), c)
                if script == 'tune.py':
                    self.assertIn(rule, values, c)
                    varied += 1
        self.assertGreaterEqual(varied, 20)

    def test_what_can_be_varied_has_the_names_of_the_rules(self):
        """stopping.stall_step sets StoppingRules::stall_step, and so on."""
        source = (SOURCE / 'bench/tune.cpp').read_text()
        for name, member in re.findall(r'\{"([\w.]+)",\s*\[\]\(Settings& s\) \{ return &s\.([\w.]+); \}', source):
            if member.startswith('rules.') and '.' in name:
                self.assertEqual('rules.' + name, member)


class PlantedFaults(unittest.TestCase):
    def parse(self, text):
        return constants.constants_of(text, 'framework/x.cpp')

    def test_comments(self):
        found = self.parse('// Of a thing. Origin: [MC20].\nconstexpr double kA = 1e-3, kB = 2;\n'
                           'constexpr int kC = 3;  // Things. Origin: two and one.\n\nconstexpr int kD = 4;\n')
        self.assertEqual([(c.name, c.value, c.what, c.origin) for c in found],
                         [('kA', '1e-3', 'Of a thing.', '[MC20].'), ('kB', '2', 'Of a thing.', '[MC20].'),
                          ('kC', '3', 'Things.', 'two and one.'), ('kD', '4', '', '')])

    def test_structs(self):
        text = 'struct %s {\n  // Origin: here.\n  double a = 1;\n  std::array<double, 2> b{1, 2};\n  int n = kC;\n};\n'
        self.assertEqual([c.name for c in self.parse(text % 'NewRules')], ['NewRules.a', 'NewRules.b'])
        self.assertEqual(self.parse(text % 'NewRecord'), [])

    def test_parts_of_a_default(self):
        found = self.parse('struct MyRules {\n  // Things. Origin: here.\n'
                           '  Other kept{.below = 1e-4, .names = {"a1"}, .steps = {2, 3}};\n};\n')
        self.assertEqual([(c.name, c.value, c.origin) for c in found],
                         [('MyRules.kept.below', '1e-4', 'here.'), ('MyRules.kept.steps', '{2, 3}', 'here.')])

    def test_functions(self):
        found = self.parse('MyRules brief_rules(int steps) {\n  MyRules rules;\n  // Origin: here.\n'
                           '  rules.a = 2;\n  rules.b.c = 1e-3;\n  rules.d = steps;\n}\n\n'
                           'void f() {\n  x.a = 1;\n}\n')
        self.assertEqual([(c.name, c.value, c.origin) for c in found],
                         [('brief_rules.a', '2', 'here.'), ('brief_rules.b.c', '1e-3', 'here.')])

    def test_what_is_no_number(self):
        self.assertEqual(self.parse('constexpr std::string_view kA = "1 2";\nconstexpr char kB = \'3\';\n'
                                    'constexpr std::array<std::string_view, 2> kC = {"x", "y"};\n'
                                    'constexpr auto kD = std::numeric_limits<std::int64_t>::max();\n'
                                    'constexpr double kE = Other::kF;\n'), [])

    def test_without_an_origin(self):
        for text in ('constexpr double kA = 1;  // of a thing\n', 'struct MyRules {\n  int a = 1;\n};\n',
                     'constexpr long long kA = 1LL << 22;  // of a thing\n', 'constexpr PetscInt kA = 300;\n',
                     'constexpr GlobalIndex kA = 2;\n', 'constexpr std::uint64_t kA = 3;\n',
                     'constexpr double kA[] = {0.1, 0.5, 1};\n', 'constexpr Table<Index, 3> kA{4, 8};\n',
                     'constexpr Size kA(3, 4);\n', 'struct MyOptions {\n  double a = 1.015;\n};\n',
                     'struct MapObjective {\n  double a = 1e3;\n};\n',
                     'struct MyRules {\n  Other kept{.below = 1e-4};\n};\n',
                     'MyRules my_rules() {\n  MyRules rules;\n  rules.a = 1e-8;\n}\n'):
            found = self.parse(text)
            self.assertEqual(len(found), 1, text)
            self.assertTrue(any('framework/x.cpp' in fault for fault in constants.faults(found)), text)

    def test_rooms(self):
        """Every folder of sources that may decide a result."""
        rooms = {path.parent.parent if path.parent.name in ('internal', 'detail') else path.parent
                 for path in SOURCE.glob('*/**/*.cpp')
                 if path.parts[len(SOURCE.parts)] in ('framework', 'terms', 'elements', 'mesh', 'energies',
                                                      'constraints', 'parametrization', 'io', 'pictures',
                                                      'results', 'distributed')}
        for room in sorted(rooms):
            name = str(room.relative_to(SOURCE))
            self.assertTrue(any(name == r or name.startswith(r + '/') for r in constants.ROOMS), name)

    def test_the_script_fails(self):
        done = subprocess.run([sys.executable, SOURCE / 'scripts/constants.py', '--root', SOURCE / 'scripts'],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn('exempt without need', done.stderr)


if __name__ == '__main__':
    unittest.main()
