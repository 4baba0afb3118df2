#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests licences: every source file names its own, REUSE and CITATION.cff are valid, and the program lists
those of all libraries that it links."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ['MAJORANT_SOURCE_DIR']
BINARY = os.environ['MAJORANT_BINARY']
BUILD = os.environ['MAJORANT_BUILD_DIR']
sys.path.insert(0, os.path.join(SOURCE, 'cmake/scripts'))
import licence_lines  # noqa: E402

# Names of loaded libraries in `majorant --licenses`.
NAMES = {
    'libamd': 'AMD', 'libcamd': 'AMD', 'libsuitesparseconfig': 'AMD', 'libmetis': 'METIS', 'libfmt': 'fmt', 'libpng16': 'libpng',
    'libjpeg': 'libjpeg-turbo', 'libOpenEXR-3_1': 'OpenEXR', 'libIex-3_1': 'Iex', 'libIlmThread-3_1': 'IlmThread',
    'libImath-3_1': 'Imath', 'libOpenEXRCore-3_1': 'OpenEXR',
    'libdraco': 'Draco', 'libmeshoptimizer': 'meshoptimizer', 'libz': 'zlib', 'libgomp': "GCC's runtime", 'libstdc++': "GCC's runtime", 'libgcc_s': "GCC's runtime",
    'libpolyclipping': 'Clipper', 'libnlopt_cxx': 'NLopt', 'libnlopt': 'NLopt', 'libceres': 'Ceres',
    'libcholmod': 'SuiteSparse', 'libspqr': 'SuiteSparse', 'libcxsparse': 'SuiteSparse', 'libcolamd': 'SuiteSparse',
    'libccolamd': 'SuiteSparse', 'libcamd': 'SuiteSparse', 'libglog': 'glog', 'libgflags': 'glog',
    'libcairo': 'cairo', 'libpixman-1': 'pixman', 'libfontconfig': 'Fontconfig', 'libfreetype': 'FreeType',
    'libexpat': 'Expat', 'libbrotlidec': 'Brotli', 'libbrotlicommon': 'Brotli', 'libX11': 'X11', 'libXext': 'X11',
    'libXrender': 'X11', 'libXau': 'X11', 'libXdmcp': 'X11', 'libxcb': 'X11', 'libxcb-shm': 'X11',
    'libxcb-render': 'X11', 'libuuid': 'libuuid', 'libbsd': 'libbsd', 'libmd': 'libmd',
    'libunwind': 'libunwind', 'liblzma': 'liblzma', 'libopenblas': 'OpenBLAS', 'liblapack': 'OpenBLAS',
    'libblas': 'OpenBLAS', 'libgfortran': 'libgfortran', 'libquadmath': 'libquadmath'}
SYSTEM = r'linux-vdso|ld-linux|lib(c|m|dl|pthread|rt)\.'


class Licences(unittest.TestCase):
    def test_every_source_file_names_its_licence(self):
        sources = list(licence_lines.sources())
        self.assertGreater(len(sources), 900)
        silent = [str(path) for path in sources if not licence_lines.has_lines(path)]
        self.assertEqual(silent, [], 'run cmake/scripts/licence_lines.py --write')

    def test_lines_are_added_where_they_belong(self):
        for name, text in (('x.cpp', 'int a;\n'), ('x.py', '#!/usr/bin/python3\n"""Doc."""\n'), ('x.js', '// What.\n'),
                           ('CMakeLists.txt', 'project(x)\n')):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / name
                path.write_text(text)
                self.assertFalse(licence_lines.has_lines(path))
                path.write_text(licence_lines.with_lines(text, path))
                self.assertTrue(licence_lines.has_lines(path), path.read_text())
                self.assertEqual(path.read_text().startswith('#!'), text.startswith('#!'))

    @unittest.skipUnless(shutil.which('reuse'), 'no reuse')
    def test_reuse_lint(self):
        # git lists the files of the project; without it, build products would count.
        if subprocess.run(['git', '-C', SOURCE, 'rev-parse'], capture_output=True).returncode != 0:
            self.skipTest('no git repository')
        done = subprocess.run(['reuse', '--root', SOURCE, 'lint'], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout[-3000:])

    def test_the_licence_texts_are_one(self):
        texts = []
        for name in ('LICENSE', 'LICENSES/BSD-3-Clause.txt'):
            with open(os.path.join(SOURCE, name)) as f:
                texts.append(f.read())
        self.assertEqual(*texts)

    def test_loaded_libraries_are_listed(self):
        listed = subprocess.run([BINARY, '--licenses'], check=True, text=True, stdout=subprocess.PIPE).stdout
        plugins = [os.path.join(os.path.dirname(BINARY), 'libmajorant_%s.so' % name) for name in ('cholmod', 'ceres')]
        libraries = []
        for binary in [BINARY] + [plugin for plugin in plugins if os.path.exists(plugin)]:
            loaded = subprocess.run(['ldd', binary], check=True, text=True, stdout=subprocess.PIPE).stdout
            libraries += [line.split()[0] for line in loaded.splitlines()]
        self.assertGreater(len(libraries), 5)
        for library in libraries:
            stem = os.path.basename(library).split('.so')[0]
            if re.search(SYSTEM, library) or stem.startswith(('libmajorant', 'libasan', 'libubsan', 'libtsan')):
                continue
            self.assertIn(stem, NAMES, 'a new library: apps/parts.cpp, and here')
            self.assertIn(NAMES[stem], listed)


class Citation(unittest.TestCase):
    """The relevant part of the schema of CITATION.cff 1.2.0."""

    def setUp(self):
        try:
            import yaml
        except ImportError:
            self.skipTest('no python3-yaml')
        with open(os.path.join(SOURCE, 'CITATION.cff')) as f:
            self.citation = yaml.safe_load(f)

    def test_required_and_known_keys(self):
        self.assertEqual(str(self.citation['cff-version']), '1.2.0')
        for key in ('message', 'title', 'authors', 'version', 'license', 'type'):
            self.assertTrue(self.citation[key], key)
        known = {'cff-version', 'message', 'title', 'abstract', 'type', 'version', 'license', 'authors', 'keywords',
                 'preferred-citation', 'repository-code', 'url', 'doi', 'date-released'}
        self.assertEqual(set(self.citation) - known, set())
        article = self.citation['preferred-citation']
        self.assertEqual(set(article), {'type', 'title', 'authors', 'journal', 'volume', 'year', 'doi'})
        self.assertRegex(article['doi'], r'^10\.\d{4,9}/\S+$')
        for person in article['authors']:
            self.assertEqual(set(person), {'family-names', 'given-names'})

    def test_the_version_is_that_of_the_program(self):
        with open(os.path.join(SOURCE, 'CMakeLists.txt')) as f:
            version = re.search(r'project\(majorant VERSION (\S+)', f.read())[1]
        self.assertEqual(self.citation['version'], version)
        printed = subprocess.run([BINARY, '--version'], check=True, text=True, stdout=subprocess.PIPE).stdout
        self.assertEqual(printed.split()[1], version)


if __name__ == '__main__':
    unittest.main()
