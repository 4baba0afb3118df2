# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that a program that uses every declaration of installed headers links, by CMake and by pkg-config,
with archives and with shared libraries of the same objects (cmake/scripts/try_configurations.py does it with
a shared build)."""
import os
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import public_names

SOURCE = os.environ['MAJORANT_SOURCE_DIR']
BUILD = os.environ['MAJORANT_BUILD_DIR']

SAMPLE = '''
#pragma once
#define SKIPPED(x) \\
  void skipped(x);
namespace majorant {
class Later;
enum class Kind { A, B };
struct Plain { int a = 1; std::function<bool(int)> ask; };  // void comment();
class Shown final : public Plain {
 public:
  explicit Shown(Plain plain = {}, int (*hook)(double) = nullptr);
  ~Shown();
  Shown(const Shown&) = delete;
  int inlined() const { return a; }
  bool operator()(int k) const;
  virtual void pure() = 0;
  [[nodiscard]] std::vector<int> list(const char* text = "};") const override;
  template <class T> T made(T t);
  friend bool operator==(const Shown&, const Shown&) = default;
  struct Part { void shown_too(); };
 private:
  decltype(Plain::a) b_, c_;
  std::map<int, std::function<void(int)>> calls_;
  double scale_ = std::sqrt(2.0);
};
template <class T> class Template { void not_here(); };
inline double twice(double x) { return 2 * x; }
constexpr int kCount = int(3);
extern template class Template<int>;
std::string_view name_of(Kind kind);
namespace detail { void hidden(); }
}  // namespace majorant
'''


class TheHeaders(unittest.TestCase):
    def test_declarations_without_a_definition(self):
        classes, functions = public_names.declared(SAMPLE)
        self.assertEqual(classes, {'Plain', 'Shown', 'Shown::Part'})
        self.assertEqual(functions, {'Shown::Shown', 'Shown::~Shown', 'Shown::operator()', 'Shown::list',
                                     'Shown::Part::shown_too', 'name_of'})

    def test_undefined_declarations_are_named(self):
        headers = {'majorant/x.h': ({'A'}, {'A::f', 'g'})}
        required, missing = public_names.expected_symbols(headers, {'A::f': {'_Z1'}, 'A': {'_ZTV1'}, 'h': {'_Z3'}})
        self.assertEqual((required, missing), ({'_Z1', '_ZTV1'}, ['majorant/x.h: g']))


class Linking:
    """Tests of the package in cls.prefix, in the folder cls.folder."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix='majorant_link_'))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.prefix = cls.folder / 'prefix'
        cls.install()
        cls.packages = {'all': public_names.Package(cls.prefix), 'framework': public_names.framework(cls.prefix)}

    def test_every_public_header_is_checked(self):
        package = self.packages['all']
        with open(Path(__file__).parents[2] / 'cmake/public_headers.txt') as f:
            listed = {line.strip() for line in f if line.startswith('majorant/') and not public_names.HIDDEN.search(line)}
        self.assertEqual(set(package.headers), listed)
        self.assertGreater(sum(len(classes) for classes, _ in package.headers.values()), 150)
        self.assertGreater(len(package.required), 450)

    def test_by_cmake(self):
        for name, package in self.packages.items():
            with self.subTest(name):
                package.link_by_cmake(self.folder / (name + '_by_cmake'))

    @unittest.skipUnless(shutil.which('pkg-config'), 'no pkg-config')
    def test_by_pkg_config(self):
        for name, package in self.packages.items():
            with self.subTest(name):
                package.link_by_pkg_config(self.folder / (name + '_by_pkg_config'))


class ThisBuild(Linking, unittest.TestCase):
    @classmethod
    def install(cls):
        public_names.output('cmake', '--install', BUILD, '--prefix', cls.prefix)

    def test_a_library_that_is_not_linked_is_found(self):
        package = public_names.Package(self.prefix, targets='majorant::solve')
        with self.assertRaisesRegex(AssertionError, 'undefined reference to .*write_svg'):
            package.link_by_cmake(self.folder / 'too_little')


def cache():
    """Returns the options with which this build was configured."""
    with open(os.path.join(BUILD, 'CMakeCache.txt')) as f:
        entries = dict(re.findall(r'^(\w+):\w+=(.*)$', f.read(), re.M))
    return {name: entries.get(name, '') for name in (
        'CMAKE_GENERATOR', 'CMAKE_BUILD_TYPE', 'CMAKE_UNITY_BUILD', 'CMAKE_CXX_COMPILER', 'CMAKE_CXX_FLAGS',
        'MAJORANT_GPL', 'BUILD_SHARED_LIBS')}


class Shared(Linking, unittest.TestCase):
    """A shared build of the objects of this one: the same sources and compiler options."""

    @classmethod
    def install(cls):
        choices = cache()
        if choices['BUILD_SHARED_LIBS'] == 'ON' or choices['CMAKE_GENERATOR'] != 'Ninja':
            raise unittest.SkipTest('no archives to make it of' if choices['CMAKE_GENERATOR'] == 'Ninja' else 'no ninja')
        tree = cls.folder / 'tree'
        others = ('APPS', 'PYTHON', 'TESTS', 'BENCH', 'EXAMPLES')
        public_names.output('cmake', '-S', SOURCE, '-B', tree, '-G', choices.pop('CMAKE_GENERATOR'),
                            *('-D%s=%s' % pair for pair in {**choices, 'BUILD_SHARED_LIBS': 'ON'}.items()),
                            *('-DMAJORANT_BUILD_%s=OFF' % name for name in others))
        for name in ('libmajorant_framework.so', 'libmajorant_solvers.so', 'libmajorant.so'):
            commands = public_names.output('ninja', '-C', tree, '-t', 'commands', name).splitlines()
            link, name_it = commands[-2:]
            for made in re.findall(r'CMakeFiles/\S+\.o\b', link):
                (tree / made).parent.mkdir(parents=True, exist_ok=True)
                (tree / made).symlink_to(os.path.join(BUILD, made))
            public_names.output('sh', '-c', link + ' && ' + name_it, cwd=tree)
        for component in ('libraries', 'development'):
            public_names.output('cmake', '--install', tree, '--prefix', cls.prefix, '--component', component)

    def test_there_are_no_archives(self):
        self.assertEqual(list(self.prefix.rglob('*.a')), [])
        self.assertEqual(len(list(self.prefix.rglob('*.so'))), 3)


if __name__ == '__main__':
    if not os.path.isdir(BUILD):
        sys.exit('set MAJORANT_BUILD_DIR')
    unittest.main()
