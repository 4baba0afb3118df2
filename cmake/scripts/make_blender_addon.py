#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Packs adapters/blender and wheels of majorant into a zip that Blender installs.

    cmake/scripts/make_blender_addon.py dist/majorant_blender.zip dist/majorant-*.whl

The zip is both an add-on in a folder for Blender before 4.2 (bl_info), and an extension
(blender_manifest.toml, whose `wheels` are filled in here). The same files give the same bytes.
"""
import json
import re
import sys
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
FOLDER = 'majorant_blender'


def manifest(wheels):
    text = (SOURCE / 'adapters/blender/blender_manifest.toml').read_text()
    names = json.dumps([f'./wheels/{wheel.name}' for wheel in wheels])
    return re.sub(r'^wheels = .*$', f'wheels = {names}', text, flags=re.M)


def contents(wheels):
    """Yields the names in the zip and their bytes."""
    folder = SOURCE / 'adapters/blender'
    for path in sorted(folder.iterdir()):
        if path.suffix == '.py':
            yield path.name, path.read_bytes()
    yield 'blender_manifest.toml', manifest(wheels).encode()
    yield 'LICENSE', (SOURCE / 'LICENSES/GPL-3.0-or-later.txt').read_bytes()
    for wheel in wheels:
        yield f'wheels/{wheel.name}', wheel.read_bytes()


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    target, wheels = Path(sys.argv[1]), [Path(name) for name in sys.argv[2:]]
    target.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target, 'w') as archive:
        for name, data in contents(wheels):
            entry = zipfile.ZipInfo(f'{FOLDER}/{name}', (2026, 1, 1, 0, 0, 0))
            entry.external_attr = 0o100644 << 16
            entry.compress_type = zipfile.ZIP_STORED if name.endswith('.whl') else zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    print(f'{target}: {target.stat().st_size / 1e6:.1f} MB')


if __name__ == '__main__':
    main()
