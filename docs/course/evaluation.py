"""Sum up and draw what a class says about the course: python evaluation.py answers.csv

The file has one line for each form, with the columns of COLUMNS; other columns are passed over.
"""

import argparse
import csv
import math
import re
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy import stats

COLUMNS = ["method_here", "method_there", "content_here", "content_there"]
QUESTIONS = {"method": "1, the way of working", "content": "2, the content"}
# How files begin that a spreadsheet writes when it is not asked for CSV.
SPREADSHEETS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")


class Refused(Exception):
    """The file cannot be used; the message says why, and what to do."""


def text_of(path):
    """Return the text of a file, in whichever way a spreadsheet has written it."""
    try:
        data = Path(path).read_bytes()
    except OSError as error:
        raise Refused(f"{path} cannot be read: {error.strerror}.") from None
    if data.startswith(SPREADSHEETS):
        raise Refused(f"{path} is a spreadsheet. Open it there, and save it as CSV.")
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", errors="replace")
    if data[:100].count(0) > 10:  # UTF-16 without its mark: every other byte is 0
        return data.decode("utf-16-be" if data[:1] == b"\0" else "utf-16-le", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")  # "ANSI"


def table_of(path):
    """Return the names of the columns and the lines below, each with its number."""
    lines = text_of(path).splitlines(keepends=True)
    declared = re.fullmatch(r'"?sep=(.)"?\s*', lines[0], re.IGNORECASE) if lines else None
    if declared:  # Excel says in this line what stands between the cells.
        lines[0] = "\n"
    first = next((line for line in lines if line.strip(' ,;"\t\r\n')), "")
    between = declared[1] if declared else max(",;\t", key=first.count)
    reader = csv.reader(lines, delimiter=between, strict=True)
    rows = []
    try:
        for row in reader:
            cells = [cell.strip() for cell in row]
            if any(cells):
                rows.append((reader.line_num, cells))
    except csv.Error as error:
        line = rows[-1][0] + 1 if rows else 1
        if "expected after" in str(error):
            why = "a quotation mark inside a cell in quotes must be doubled."
            raise Refused(f"{path}, line {line}: {why}") from None
        raise Refused(f"{path}, line {line}: there is no end to a cell in quotes.") from None
    if not rows:
        raise Refused(f"{path} is empty.")
    header = [re.sub(r"[\s_-]+", "_", name.lower()) for name in rows[0][1]]
    return header, rows[1:]


def score_of(text, where):
    """Return the number that a cell holds; nan where the student gave none."""
    if not text:
        return math.nan
    whole = re.fullmatch(r"([1-5])([.,]0*)?", text)
    if whole is None:
        raise Refused(f"{where}: {text} is not 1, 2, 3, 4 or 5. Correct it, or leave it empty.")
    return int(whole[1])


def read_scores(path):
    """Return the scores of each column, one for each form."""
    header, rows = table_of(path)
    for name in COLUMNS:
        if header.count(name) != 1:
            how = "no column" if name not in header else "more than one column"
            found = ", ".join(filter(None, header))
            raise Refused(
                f"{path} has {how} {name}. Its first line must name the columns "
                f"{', '.join(COLUMNS)}, but is {found:.100}."
            )
    if not rows:
        raise Refused(f"{path} holds no form: there is nothing below the names of the columns.")
    scores = {name: np.full(len(rows), math.nan) for name in COLUMNS}
    for form, (line, cells) in enumerate(rows):
        if any(cells[len(header) :]):
            raise Refused(f"{path}, line {line}, has more cells than there are columns.")
        for name in COLUMNS:
            cell = dict(zip(header, cells)).get(name, "")
            scores[name][form] = score_of(cell, f"{path}, line {line}, {name}")
    for name, given in scores.items():
        if np.isnan(given).all():
            raise Refused(f"{path}: there is no answer in the column {name}.")
    return scores


def half_interval(numbers):
    """Return how far the mean may be off, with 95 % certainty, by Student's t."""
    count = len(numbers)
    return stats.t.ppf(0.975, count - 1) * np.std(numbers, ddof=1) / math.sqrt(count)


def decimals(error):
    """Return how many decimals tell something: two digits of an error that begins with 1."""
    size = math.floor(math.log10(error))
    return max(0, -size + (error / 10**size < 2))


def summary(scores):
    """Return what there is to say of the scores, line by line."""
    lines = []
    for name, scored in scores.items():
        given = scored[~np.isnan(scored)]
        answers = f"{len(given)} answer{'s' * (len(given) != 1)}"
        spread = f", spread {np.std(given, ddof=1):.1f}" if len(given) > 1 else ""
        lines.append(f"{name:14} {answers}, mean {given.mean():.1f}{spread}")
    lines.append("This course less the other one:")
    for question, title in QUESTIONS.items():
        lines.append(f"{title}: {compared(scores, question)}")
    return lines


def signed(number, places=0):
    """Return the number with its sign, which 0 has not."""
    text = f"{number:+.{places}f}"
    return text if float(text) else text[1:]


def compared(scores, question):
    """Say how the answers of the same students differ between the two courses."""
    difference = scores[f"{question}_here"] - scores[f"{question}_there"]
    difference = difference[~np.isnan(difference)]
    count = len(difference)
    if count == 0:
        return "no student gave both numbers, so nothing can be compared"
    if count == 1:
        return f"{signed(difference[0])}, from one student: too few to tell more"
    if np.ptp(difference) == 0:
        few = f"{signed(difference[0])} from each of {count} students"
        return f"{few}: where all agree, nothing tells how far another class would differ"
    error = half_interval(difference)
    places = decimals(error)
    told = f"{signed(difference.mean(), places)} ± {error:.{places}f}, from {count} students"
    may_be = " (may be chance)" if abs(difference.mean()) < error else ""
    return told + may_be


def draw(scores, title):
    """Draw a histogram for each question, and its mean beside that of the other course."""
    plt.style.use("canim.style")
    fig, axes = plt.subplots(2, 2, figsize=(6.4, 5.6), width_ratios=[1, 1.2])
    fig.suptitle(title)
    for (left, right), (question, name) in zip(axes, QUESTIONS.items()):
        here, there = scores[f"{question}_here"], scores[f"{question}_there"]
        counts = [np.sum(here == score) for score in range(1, 6)]
        left.bar(range(1, 6), counts, color="tab:blue")
        left.set(title=name, xlabel="score, this course", ylabel="students")
        left.set_xticks(range(1, 6))
        means = [np.nanmean(there), np.nanmean(here)]
        names, colors = ["other course", "this course"], ["tab:red", "black"]
        bars = right.barh(names, means, height=0.5, color=colors)
        right.bar_label(bars, fmt="%.1f", padding=4)
        right.set(xlim=(1, 5.5), xticks=range(1, 6), xlabel="mean score")
        right.grid(visible=False, axis="y")
    return fig


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split(":")[0])
    parser.add_argument("file", help="the answers, saved as CSV")
    file = parser.parse_args(arguments).file
    try:
        scores = read_scores(file)
    except Refused as problem:
        print(problem, file=sys.stderr)
        return 2
    print("\n".join(summary(scores)))
    draw(scores, Path(file).name)
    plt.show()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
