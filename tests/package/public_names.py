# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Finds declarations of installed headers without definitions, and writes a program that needs all of them to
link.

Declarations come from the headers and symbols from the installed libraries, not from the link line of a
program, so that a class whose library is not linked or not installed is found.
"""
import os
import re
import subprocess
from pathlib import Path

NAMESPACE = 'majorant'
# Headers of detail/ are for templates of public headers only. Those of adapters/ define nothing to link, and
# include headers of libraries that majorant does not link.
HIDDEN = re.compile('/(detail|adapters)/')


def code_of(text):
    """Returns the code without comments, preprocessor lines and contents of quotes."""
    text = re.sub(r'//[^\n]*|/\*.*?\*/', ' ', text, flags=re.S)
    text = re.sub(r'"(\\.|[^"\\\n])*"|\'(\\.|[^\'\\\n])\'', '0', text)
    return re.sub(r'^[ \t]*#([^\n]*\\\n)*[^\n]*', ' ', text, flags=re.M)


def end_of_block(code, place):
    """Returns the place behind the brace that closes the one at `place`."""
    depth = 0
    for k in range(place, len(code)):
        depth += {'{': 1, '}': -1}.get(code[k], 0)
        if depth == 0:
            return k + 1
    raise ValueError('a brace is not closed: ' + code[place:place + 80])


def statements(code):
    """Yields (text before it, block or None) of statements, which end with a semicolon or have a block;
    blocks are not entered."""
    begin, parentheses, k = 0, 0, 0
    while k < len(code):
        c = code[k]
        parentheses += {'(': 1, ')': -1}.get(c, 0)
        if c == ';' and parentheses == 0:
            yield code[begin:k].strip(), None
            begin = k + 1
        elif c == '{' and parentheses == 0:
            end = end_of_block(code, k)
            yield code[begin:k].strip(), code[k + 1:end - 1]
            begin, k = end, end - 1
        k += 1


def function_name(statement):
    """Returns the name of a declared function, or None for other declarations and functions that need no
    symbol."""
    statement = re.sub(r'\[\[.*?\]\]|\b(alignas|decltype)\([\w:]+\)', ' ', statement).strip()
    if re.match(r'(friend|using|typedef|template|static_assert|extern template|class|struct|enum)\b', statement):
        return None
    if re.search(r'=\s*(0|default|delete)$', statement):
        return None
    operator = re.search(r'\boperator\s*(\(\)|[^\s\w(]+|\w+)\s*\(', statement)
    if operator:
        return 'operator' + operator[1]
    angle = 0
    for k, c in enumerate(statement):
        angle += {'<': 1, '>': -1}.get(c, 0)
        if c == '=' and angle == 0:
            return None
        if c == '(' and angle == 0:
            if statement[k + 1:].lstrip().startswith('*'):  # a pointer to a function
                return None
            name = re.search(r'~?\w+$', statement[:k].rstrip())
            return name[0] if name else None
    return None


def without_access(statement):
    return re.sub(r'^((public|protected|private)\s*:\s*)+', '', statement).strip()


def members(code, scope=''):
    """Returns (classes, functions) that a scope defines and declares, with their scopes in namespace
    majorant."""
    classes, functions = set(), set()
    for text, block in statements(code):
        text = without_access(text)
        kind = re.match(r'(?:class|struct)\s+(?:\[\[.*?\]\]\s*|alignas\(\w+\)\s*)*(\w+)\b(?!\s*[(<])', text)
        if block is None:
            name = function_name(text)
            functions |= {scope + name} if name else set()
        elif kind and not text.endswith(')'):
            classes.add(scope + kind[1])
            inner = members(block, scope + kind[1] + '::')
            classes, functions = classes | inner[0], functions | inner[1]
    return classes, functions


def declared(text):
    """Returns (classes, functions) of a header; nested namespaces are not public."""
    classes, functions = set(), set()
    for head, block in statements(code_of(text)):
        if re.fullmatch(r'namespace\s+' + NAMESPACE, head):
            inner = members(block)
            classes, functions = classes | inner[0], functions | inner[1]
    return classes, functions


def declared_in(include):
    """Returns (classes, functions) for each public header of the folder, by relative path."""
    return {str(path.relative_to(include)): declared(path.read_text())
            for path in sorted((include / NAMESPACE).rglob('*.h')) if not HIDDEN.search(str(path))}


def symbols_in(libraries):
    """Returns {name without namespace and arguments: symbols} of functions and virtual tables."""
    found = {}
    for library in libraries:
        shared = ['--dynamic'] if '.so' in library.name else []
        listed = output('nm', *shared, '--defined-only', '--extern-only', '--format=posix', library)
        mangled = [line.split()[0] for line in listed.splitlines() if re.match(r'_Z\S+ [TVD] ', line)]
        plain = output('c++filt', input='\n'.join(mangled)).splitlines()
        for symbol, name in zip(mangled, plain):
            name = re.sub(r'\[abi:\w+\]', '', name)
            shape = re.match(r'(?:vtable|typeinfo) for (.*)|([^(<]*?operator\(\)|[^(<]*?operator<+|[^(<]*)\(', name)
            name = shape and (shape[1] or shape[2])
            if name and name.startswith(NAMESPACE + '::'):
                found.setdefault(name[len(NAMESPACE) + 2:], set()).add(symbol)
    return found


def expected_symbols(headers, symbols):
    """Returns (symbols of all declarations, names that no library defines)."""
    required, missing = set(), []
    for header, (classes, functions) in headers.items():
        missing += ['%s: %s' % (header, name) for name in sorted(functions) if name not in symbols]
        for name in classes | functions:
            required |= symbols.get(name, set())
    return required, missing


def output(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, **options)
    assert done.returncode == 0, '%s: exit %d\n%s' % (command, done.returncode, done.stdout[-5000:])
    return done.stdout


def write_program(headers, required, folder):
    """Writes classes.cpp, which refers to every class of its header, and symbols.cpp, which refers to every
    symbol and counts them."""
    lines = ['#include "%s"' % header for header in headers]
    lines += ['static_assert(sizeof(%s::%s) > 0);' % (NAMESPACE, name) for classes, _ in headers.values()
              for name in sorted(classes) if '::' not in name]  # others may be private
    (folder / 'classes.cpp').write_text('\n'.join(lines) + '\n')
    lines = ['extern "C" const char symbol_%d[] __asm__("%s");' % pair for pair in enumerate(sorted(required))]
    lines += ['const char* volatile symbols[] = {', *('  symbol_%d,' % k for k in range(len(required))), '};',
              'int main() {', '  int count = 0;', '  for (const char* symbol : symbols) count += symbol != nullptr;',
              '  return count == %d ? 0 : 1;' % len(required), '}']
    (folder / 'symbols.cpp').write_text('\n'.join(lines) + '\n')


PROJECT = """cmake_minimum_required(VERSION 3.22)
project(every_name LANGUAGES C CXX)
find_package(majorant REQUIRED %s)
add_executable(every_name classes.cpp symbols.cpp)
target_link_libraries(every_name PRIVATE %s)
"""


class Package:
    """An installed package. `find`: the words after find_package(majorant REQUIRED; `targets`: the libraries
    that programs link; `module`: its name in pkg-config. Only headers and libraries count for whose paths and
    names is_header and is_library hold."""

    def __init__(self, prefix, find='', targets='majorant::majorant', module='majorant',
                 is_header=lambda path: True, is_library=lambda name: True):
        self.prefix, self.find, self.targets, self.module = prefix, find, targets, module
        libraries = [path for pattern in ('libmajorant*.so', 'libmajorant*.a') for path in prefix.rglob(pattern)
                     if is_library(path.name.split('.')[0])]
        self.headers = {path: names for path, names in declared_in(prefix / 'include').items() if is_header(path)}
        self.required, missing = expected_symbols(self.headers, symbols_in(libraries))
        assert libraries and not missing, 'declared, and in no installed library: ' + ', '.join(missing)

    def link_by_cmake(self, folder):
        folder.mkdir()
        write_program(self.headers, self.required, folder)
        (folder / 'CMakeLists.txt').write_text(PROJECT % (self.find, self.targets))
        output('cmake', '-S', folder, '-B', folder / 'build', '-DCMAKE_PREFIX_PATH=%s' % self.prefix,
               '-DCMAKE_CXX_FLAGS=-O0')
        output('cmake', '--build', folder / 'build')
        output(folder / 'build/every_name')

    def link_by_pkg_config(self, folder):
        folder.mkdir()
        write_program(self.headers, self.required, folder)
        libdir = next(self.prefix.rglob('majorant.pc')).parent
        environment = dict(os.environ, PKG_CONFIG_PATH=str(libdir), LD_LIBRARY_PATH=str(libdir.parent))
        flags = output('pkg-config', '--cflags', '--libs', self.module, env=environment).split()
        output(os.environ.get('CXX', 'c++'), '-std=c++20', folder / 'symbols.cpp', '-o', folder / 'every_name', *flags)
        output(folder / 'every_name', env=environment)


FRAMEWORK = ('framework', 'comparison', 'elements', 'energies', 'terms')


def framework(prefix):
    """Returns the framework component: its modules without parts that need Ceres or CHOLMOD."""
    return Package(prefix, 'COMPONENTS framework', 'majorant::energies majorant::comparison', 'majorant-framework',
                   lambda path: path.split('/')[1] in FRAMEWORK and not path.endswith(('/ceres_minimizer.h', '/cholmod_solver.h', '/ceres_methods.h', '/cholmod_methods.h')),
                   lambda name: name.removeprefix('libmajorant_') in FRAMEWORK)
