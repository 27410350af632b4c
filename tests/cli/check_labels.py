#!/usr/bin/env python3
"""tests/cli/check_labels.py - the numbers of a PDF stand where the JSON says.

    check_labels.py PATTERN.pdf PATTERN.json

Both are outputs of one run. pdftotext -bbox says where each word of the PDF is; every label of an
edge has to be there, its middle within 1 mm, and nothing that looks like a number is elsewhere. A
seam has two labels or, where its mate is the obvious neighbour, none. Exit status 0, 1, or 77
without pdftotext."""

import collections
import json
import math
import re
import shutil
import subprocess
import sys

MM = 25.4 / 72
NEAR_MM = 1.0
MAPS_A_PAGE = 6  # on the covers


def words_of(pdf):
    """For each page its width, height and words: text, middle in mm from the lower left corner."""
    text = subprocess.run(['pdftotext', '-bbox', pdf, '-'], check=True, capture_output=True).stdout
    pages = []
    for line in text.decode('utf-8', 'replace').splitlines():
        numbers = [float(n) for n in re.findall(r'="([-0-9.]+)"', line)]
        if '<page' in line:
            height = numbers[1] * MM
            pages.append((numbers[0] * MM, height, []))
        elif '<word' in line:
            x0, y0, x1, y1 = (n * MM for n in numbers)
            word = re.search(r'>([^<]*)</word', line).group(1)
            pages[-1][2].append((word, (x0 + x1) / 2, height - (y0 + y1) / 2))
    return pages


def labels_of(pattern, sheet):
    """The numbers on a sheet: text, middle, edge."""
    pieces = {piece['id']: piece for piece in pattern['pieces']}
    for place in sheet['placements']:
        turn = math.radians(place['rotation_deg'])
        c, s = math.cos(turn), math.sin(turn)
        for label in pieces[place['piece']]['labels']:
            if label.get('edge') is not None:
                x, y = label['x'], label['y']
                yield label['text'], c * x - s * y + place['x'], s * x + c * y + place['y'], label['edge']


def check_seams(pattern):
    """Two labels, or none, for each number."""
    counts = collections.Counter(label['text'] for piece in pattern['pieces']
                                 for label in piece['labels'] if label.get('edge') is not None)
    return ['number %s stands %d times' % (text, n) for text, n in counts.items() if n != 2]


def is_shown(sheet, x, y):
    """On a tile a number may be cut off, or lie on another one."""
    x0, y0, x1, y1 = sheet['printable']
    return sheet['kind'] != 'tile' or (x0 + 4 < x < x1 - 4 and y0 + 4 < y < y1 - 4)


def check(pages, pattern):
    problems, found, nearest = check_seams(pattern), 0, 0.0
    posters = max((sheet.get('tile', {}).get('poster', 0) for sheet in pattern['sheets']), default=0)
    covers = (posters + MAPS_A_PAGE - 1) // MAPS_A_PAGE
    for sheet, (_, _, words) in zip(pattern['sheets'], pages[covers:]):
        for text, x, y, edge in labels_of(pattern, sheet):
            if not is_shown(sheet, x, y):
                continue
            away = min((math.hypot(x - u, y - v) for word, u, v in words if word == text),
                       default=math.inf)
            nearest = max(nearest, away if away < math.inf else 0)
            found += away <= NEAR_MM
            if away > NEAR_MM:
                problems.append('number %s of edge %s is %.1f mm away on sheet %s'
                                % (text, edge, away, sheet['id']))
    return found, nearest, problems


def main():
    if not shutil.which('pdftotext'):
        return 77
    with open(sys.argv[2], encoding='utf-8') as file:
        pattern = json.load(file)
    found, nearest, problems = check(words_of(sys.argv[1]), pattern)
    for problem in problems[:20]:
        print(problem)
    print('%d numbers found, at most %.2f mm away; %d problems' % (found, nearest, len(problems)))
    return 1 if problems or not found else 0


if __name__ == '__main__':
    sys.exit(main())
