#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the pages of write_comparison_html in a browser.

    comparison_page.py PAGE.html...

Headless Chromium opens a copy of each page with an additional script, which records errors and refused
resources, uses every control, points at every tenth point and moves by keys. Its findings are written into
the document. Exit code 1 with a message at the first defect; 77 without Chromium.
"""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

CHROMIUM = shutil.which('chromium')

WATCH = """<script>
const surprises = [];
addEventListener('error', (event) => surprises.push(event.message || 'a resource'));
document.addEventListener('securitypolicyviolation', (e) => surprises.push(e.violatedDirective));
</script>"""

PROBE = """<script type="module">
const found = {};
const count = (selector) => document.querySelectorAll(selector).length;
const survey = () => ({
  runs: count('figure .run'), markers: count('figure .marker'), titles: count('figure svg > title'),
  // Attributes only: texts of a hostile comparison may say anything.
  unplaced: [...document.querySelectorAll('figure svg *')].filter((e) => [...e.attributes].some(
      (a) => /NaN|Infinity|undefined/.test(a.value))).length,
});
try {
  found.start = survey();
  found.legend = count('#legend button');
  found.rows = count('tbody tr');
  found.swatches = count('tbody th svg');
  found.hostile = count('#hostile');
  found.tips = 0;
  for (const chart of window.comparisonPage.charts) {
    for (const place of chart.placed.filter((_, i) => i % 10 === 0)) {
      const box = chart.svg.getBoundingClientRect();
      const scale = box.width / chart.svg.viewBox.baseVal.width;
      chart.svg.dispatchEvent(new PointerEvent('pointermove', {
        clientX: box.left + scale * place.x, clientY: box.top + scale * place.y}));
      const tip = chart.tip.getBoundingClientRect();
      if (chart.tip.hidden || /NaN|undefined|null/.test(chart.tip.querySelector('dl').textContent))
        surprises.push('tip of ' + place.index);
      if (!(tip.left >= 0 && tip.right <= innerWidth)) surprises.push('tip outside the window');
      ++found.tips;
    }
    chart.svg.dispatchEvent(new PointerEvent('pointerleave'));
    if (!chart.tip.hidden) surprises.push('the tip stays');
    for (const key of ['ArrowRight', 'ArrowRight', 'ArrowDown', 'ArrowUp', 'ArrowLeft', 'Escape'])
      chart.svg.dispatchEvent(new KeyboardEvent('keydown', {key}));
  }
  found.views = [];
  for (const button of document.querySelectorAll('.switch button')) {
    button.click();
    if (button.getAttribute('aria-pressed') !== 'true') surprises.push('a switch does not switch');
    found.views.push(survey());
  }
  for (const button of document.querySelectorAll('#legend button')) button.click();
  found.hidden = survey();
  const table = document.querySelector('.scroll');
  await new Promise((done) => setTimeout(done, 100));  // observers
  found.goesOn = [!document.getElementById('goes-on').hidden, table.scrollWidth > table.clientWidth];
  table.scrollLeft = 1e5;
  const ends = [...document.querySelectorAll('thead tr:first-child th, tbody tr:first-child > *')].map(
      (cell) => cell.getBoundingClientRect().right);
  found.reachable = Math.max(...ends) <= innerWidth;
  const first = document.querySelector('tbody th');
  found.methodInSight = !first || first.getBoundingClientRect().left >= 0;
  found.overflow = document.documentElement.scrollWidth - innerWidth;
} catch (error) {
  surprises.push(String(error.stack));
}
found.ready = document.documentElement.dataset.ready;
found.surprises = surprises;
const outcome = document.createElement('pre');
outcome.id = 'outcome';
outcome.textContent = JSON.stringify(found);
document.body.append(outcome);
</script>"""


def probe(page, folder, width):
    """Returns the script's findings in a copy of the page, in a window of this width."""
    with open(page, encoding='utf-8', newline='') as f:
        text = f.read()
    copy = os.path.join(folder, os.path.basename(page))
    with open(copy, 'w', encoding='utf-8', newline='') as f:
        f.write(text.replace('<head>', '<head>' + WATCH, 1)
                .replace('</body>\n</html>', PROBE + '</body>\n</html>'))
    command = [CHROMIUM, '--headless', '--no-sandbox', '--disable-gpu', '--no-first-run',
               '--disable-dev-shm-usage', '--user-data-dir=' + os.path.join(folder, 'profile'),
               f'--window-size={width},900', '--virtual-time-budget=5000', '--dump-dom',
               'file://' + copy]
    document = subprocess.run(command, capture_output=True, timeout=120, check=True)
    outcome = re.search(r'<pre id="outcome">(.*?)</pre>', document.stdout.decode(), re.S)
    if not outcome:
        sys.exit(f'{page}: the probe did not run\n{document.stderr.decode()}')
    data = re.search(r'id="data">(.*?)</script>', text, re.S)
    return json.loads(html.unescape(outcome[1])), json.loads(data[1])


def check(page, folder, width):
    found, data = probe(page, folder, width)

    def expect(truth, what):
        if not truth:
            sys.exit(f'{page}, {width} wide: {what}\n{json.dumps(found, indent=1)}')

    runs = len(data['runs'])
    energies = [e for run in data['runs'] for e in run['energy'] if e is not None]
    expect(found['surprises'] == [] and found['ready'] == 'yes', 'errors')
    expect(found['legend'] == found['rows'] == found['swatches'] == runs, 'a run is missing')
    expect(found['hostile'] == 0, 'a text became an element')
    expect(found['overflow'] <= 0, 'wider than the window')
    expect(found['goesOn'][0] == found['goesOn'][1], 'nothing says that the table goes on')
    expect(found['reachable'], 'a column of the table is out of reach')
    expect(found['methodInSight'] or width > 640, 'nothing says whose numbers these are')
    for survey in [found['start'], *found['views']]:
        expect(survey['runs'] == 2 * runs and survey['titles'] == 2, 'charts are not complete')
        expect(survey['unplaced'] == 0, 'a mark without a place')
        expect((survey['markers'] > 0) == (len(energies) > 0), 'points are not drawn')
    expect((found['tips'] > 0) == (len(energies) > 0), 'no tooltips')
    expect(found['hidden']['runs'] == 0, 'the legend does not hide runs')


def main():
    if not CHROMIUM:
        print('skipped: no chromium')
        return 77
    folder = tempfile.mkdtemp(prefix='majorant_pages_')
    try:
        for page in sys.argv[1:]:
            check(page, folder, 1400)
        check(sys.argv[-1], folder, 500)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return 0


if __name__ == '__main__':
    sys.exit(main())
