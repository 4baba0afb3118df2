#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Names source files without the two lines of their licence (exit code 1).

cmake/scripts/licence_lines.py             lists the files
cmake/scripts/licence_lines.py --write     adds the lines: at the end of C++, which begins with its purpose
"""
import os
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
LINES = ('SPDX-FileCopyrightText: 2026 the majorant developers', 'SPDX-License-Identifier: BSD-3-Clause')
# Folders with a licence of their own: add-ons that use Blender's module bpy.
LICENCES = {'adapters/blender/': 'SPDX-License-' 'Identifier: GPL-3.0-or-later'}
AT_END = ('.cpp', '.h')
MARKS = {'.cpp': '//', '.h': '//', '.js': '//', '.mjs': '//', '.py': '#', '.pyi': '#', '.cmake': '#', '.sh': '#'}
LEFT_OUT = ('pictures/web/dist/',)  # bundles, whose licences are in .reuse/dep5
FOLDERS_LEFT_OUT = ('build', 'out', 'node_modules', '.git', '__pycache__')


def sources():
    listed = subprocess.run(['git', 'ls-files', '-co', '--exclude-standard'], cwd=SOURCE, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    names = listed.stdout.splitlines()
    if listed.returncode != 0:
        for folder, folders, files in os.walk(SOURCE):
            folders[:] = [f for f in folders if f not in FOLDERS_LEFT_OUT]
            names += [os.path.relpath(os.path.join(folder, name), SOURCE) for name in files]
    for name in names:
        path = SOURCE / name
        if (path.suffix in MARKS or path.name == 'CMakeLists.txt') and path.is_file() \
                and not name.startswith(LEFT_OUT):
            yield path


def lines_of(path):
    name = os.path.relpath(path, SOURCE)
    return (LINES[0], next((line for folder, line in LICENCES.items() if name.startswith(folder)), LINES[1]))


def has_lines(path):
    lines = path.read_text().splitlines()
    place = lines[-2:] if path.suffix in AT_END else lines[:4]
    # In any order: reuse reads blocks of 4096 bytes, and must not see half of an identifier.
    return sorted(line.lstrip('/# ') for line in place if 'SPDX-' in line) == sorted(lines_of(path))


def with_lines(text, path):
    mark = MARKS.get(path.suffix, '#')
    block = ''.join('%s %s\n' % (mark, line) for line in lines_of(path))
    if path.suffix in AT_END:
        return text.rstrip('\n') + '\n\n' + block
    first, _, rest = text.partition('\n') if text.startswith('#!') else ('', '', text)
    return (first + '\n' if first else '') + block + ('\n' if rest.startswith(mark) else '') + rest


def main():
    missing = [path for path in sources() if not has_lines(path)]
    for path in missing:
        print(path.relative_to(SOURCE))
        if '--write' in sys.argv[1:]:
            path.write_text(with_lines(path.read_text(), path))
    return 1 if missing and '--write' not in sys.argv[1:] else 0


if __name__ == '__main__':
    sys.exit(main())
