#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the site in build/site: docs/, README.md, the viewer and the pages of the public headers, with a
search.

Copies the pages into build/site_pages, where links to files outside of docs/ become links to copies of these
files. doxygen (cmake/scripts/doxygen_filter.py) and mkdocs (mkdocs.yml) make their pages. Then every link of
every page must lead to an existing file and anchor. A warning or a broken link ends the script with exit code
1.

    cmake/scripts/make_site.py [--no-headers]
"""
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'bench'))
import measurements  # noqa: E402

PAGES, SITE = ROOT / 'build/site_pages', ROOT / 'build/site'
OTHERS = {'README.md': 'index.md', 'CONTRIBUTING.md': 'contributing.md', 'CHANGELOG.md': 'changelog.md'}
LINK = re.compile(r'((?:\]\(|src="|href="))([^)"#:\s]*)(#[^)"\s]*)?(?=[)"])')


def with_links(page, text):
    """Returns the text of a page of the repository, with links to the copies."""
    def replaced(match):
        start, target, anchor = match[1], match[2], match[3] or ''
        if not target:
            return match[0]
        path = Path(os.path.normpath(page.parent / target))
        name = str(path.relative_to(ROOT))
        if name.startswith('docs/'):
            new = name[len('docs/'):]
        elif name in OTHERS:
            new = OTHERS[name]
        elif name.startswith('bench/results/'):
            new = 'measurements.md'
            anchor = '' if path.name == 'README.md' else '#' + measurements.anchor(path.stem)
        else:
            new = 'files/' + (name + '/README.md' if path.is_dir() else name)
            if new.endswith('.md'):
                new += '.txt'  # a file to display, not a page of the site
            if not (PAGES / new).exists():
                (PAGES / new).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(path / 'README.md' if path.is_dir() else path, PAGES / new)
            anchor = ''
        return start + new + anchor
    parts = re.split(r'(^```.*?^```$)', text, flags=re.S | re.M)
    return ''.join(part if k % 2 else LINK.sub(replaced, part) for k, part in enumerate(parts))


def github_anchor(text, separator):
    """Returns GitHub's anchor of a heading, which links use."""
    return re.sub(r'[^\w -]', '', text.lower()).replace(' ', separator)


def copy_pages():
    shutil.rmtree(PAGES, ignore_errors=True)
    shutil.copytree(ROOT / 'docs', PAGES)
    for page in [*(ROOT / 'docs').glob('*.md'), *(ROOT / name for name in OTHERS)]:
        text = with_links(page, page.read_text())
        (PAGES / OTHERS.get(page.name, page.name)).write_text(text)
    (PAGES / 'measurements.md').write_text(measurements.page())
    (PAGES / 'viewer.md').write_text('---\nhide: [navigation, toc]\n---\n\n# The viewer\n\nA page that `majorant parametrize -o creature.html --snapshots 16` '
                                     'wrote, [by itself](creature.html); [what it shows](web_page.md#what-it-shows).\n\n'
                                     '<iframe src="creature.html" title="the map of the creature" '
                                     'style="width: 100%; height: 90vh; border: 1px solid gray"></iframe>\n')
    (PAGES / 'api.md').write_text('# Headers\n\n<a href="api/files.html">Every public header</a>, with examples, and '
                                  '<a href="api/annotated.html">every class</a>.\n')


def leave_out_of_search(page):
    """Leaves tables of figures, which contain every word, out of the search."""
    index = SITE / 'search/search_index.json'
    if not index.exists():
        return
    found = json.loads(index.read_text())
    found['docs'] = [entry for entry in found['docs'] if not entry['location'].startswith(page)]
    index.write_text(json.dumps(found))


def make_header_pages():
    """Makes build/site/api. Returns doxygen's warnings."""
    headers = [ROOT / line[len('majorant/'):]
               for line in (ROOT / 'cmake/public_headers.txt').read_text().splitlines()
               if line.startswith('majorant/') and '/detail/' not in line]
    values = {'PROJECT_VERSION': '', 'PROJECT_DESCRIPTION': 'public headers', 'PROJECT_BINARY_DIR': str(ROOT / 'build'),
              'MAJORANT_API_INPUT': ' '.join(map(str, headers)), 'Python3_EXECUTABLE': sys.executable,
              'PROJECT_SOURCE_DIR': str(ROOT)}
    text = (ROOT / 'cmake/Doxyfile.in').read_text()
    for name, value in values.items():
        text = text.replace('@%s@' % name, value)
    text += '\n'.join(['', 'USE_MDFILE_AS_MAINPAGE =', 'OUTPUT_DIRECTORY = %s' % SITE, 'HTML_OUTPUT = api',
                       'WARN_IF_UNDOCUMENTED = NO', 'WARN_LOGFILE =', ''])
    return subprocess.run(['doxygen', '-'], input=text, text=True, check=True, cwd=ROOT, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE).stderr


class Links(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.targets, self.anchors = [], {''}
        self.feed(path.read_text(errors='replace'))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors |= {values.get('id'), values.get('name')}
        for key in ('href', 'src'):
            if values.get(key) and tag in ('a', 'img', 'link', 'script', 'iframe'):
                self.targets.append(values[key])


def broken_links():
    """Yields the broken links of mkdocs' pages; doxygen's pages are only targets."""
    pages = {path: Links(path) for path in SITE.glob('*.html') if path.name != '404.html'}
    for path, page in pages.items():
        for target in page.targets:
            if re.match(r'\w+:|//', target):
                continue
            name, _, anchor = unquote(target).partition('#')
            there = Path(os.path.normpath(path.parent / name)) if name else path
            if not there.exists():
                yield '%s: no %s' % (path.name, name)
            elif there in pages and anchor not in pages[there].anchors:
                yield '%s: no %s' % (path.name, target)


def main():
    copy_pages()
    done = subprocess.run(['mkdocs', 'build', '--strict'], cwd=ROOT, text=True,
                          stderr=subprocess.PIPE, env={**os.environ, 'PYTHONPATH': str(ROOT / 'cmake/scripts'),
                                                'PYTHONWARNINGS': 'ignore'})
    leave_out_of_search('measurements.html')
    warnings = '\n'.join(line for line in done.stderr.splitlines() if re.search('WARNING|ERROR|Error:|Aborted', line))
    warnings += '\n' if warnings else ''
    warnings += make_header_pages() if '--no-headers' not in sys.argv else ''
    faults = [*warnings.splitlines(), *broken_links()]
    print('\n'.join(faults) if faults else 'the site: %s' % (SITE / 'index.html'))
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
