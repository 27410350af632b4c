#!/usr/bin/env python3
"""tests/cli/check_guide.py - the guide at the end of a PDF tells of every seam, once and in order.

    check_guide.py PATTERN.pdf PATTERN.json

The steps' titles ("3. Seams 17-23") must name the numbers of the pattern's sections, one after the
other, without a gap; each number stands in a picture or among those that are hidden; what closes a
body must be told. Exit status 0, 1, or 77 without
pdftotext."""

import json
import re
import shutil
import subprocess
import sys

TITLE = re.compile(r'^(\d+)\. (?:Seams? (\d+)(?:\u2013(\d+))?|Seams without numbers)', re.M)


def text_of(pdf):
    """The text of the guide's pages."""
    text = subprocess.run(['pdftotext', pdf, '-'], check=True, capture_output=True).stdout
    pages = text.decode('utf-8', 'replace').split('\f')
    first = next((i for i, page in enumerate(pages) if 'How to build it' in page), len(pages))
    return '\n'.join(pages[first:])


def sections_of(pattern):
    """For each step the lowest and highest number of its seams."""
    steps = {}
    for place, seam in enumerate(pattern['seams'], 1):
        number = seam.get('number', place)
        low, high = steps.get(seam['section'], (10 ** 9, 0))
        if not seam.get('obvious'):
            steps[seam['section']] = min(low, number), max(high, number)
    return [steps[step] for step in sorted(steps) if step]


def check(text, pattern):
    problems = []
    if 'How to build it' not in text:
        return ['there is no guide']
    titles = [(int(step), int(low or 0), int(high or low or 0))
              for step, low, high in TITLE.findall(text)]
    titles.sort()
    wanted = [(i, low, high) for i, (low, high) in enumerate(sections_of(pattern), 1)]
    if titles != wanted:
        problems.append('the steps are %s instead of %s' % (titles[:60], wanted[:60]))
    told = sum(high - low + 1 for _, low, high in titles)
    numbered = sum(not seam.get('obvious') for seam in pattern['seams'])
    if told != numbered:
        problems.append('%d of %d seams are told' % (told, numbered))
    words = set(re.findall(r'(?<!\S)\d+(?=[,.]?(?:\s|$))', TITLE.sub('', text)))
    unseen = [seam.get('number', place) for place, seam in enumerate(pattern['seams'], 1)
              if not seam.get('obvious') and str(seam.get('number', place)) not in words]
    if unseen:
        problems.append('neither in a picture nor among the hidden: %s' % unseen)
    closing = len(re.findall(r'\bclose[s]?\s+(?:the\s+model|it\b)', text))
    if any(seam.get('closing') for seam in pattern['seams']) and not closing:
        problems.append('nothing tells how the model is closed')
    return problems


def main():
    if not shutil.which('pdftotext'):
        return 77
    with open(sys.argv[2], encoding='utf-8') as file:
        problems = check(text_of(sys.argv[1]), json.load(file))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())
