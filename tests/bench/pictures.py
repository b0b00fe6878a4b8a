"""Tables as CSV files and pictures of several lines, shared by the timers."""

import csv
import shutil
import subprocess

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555", "#000000")
MARKERS = (5, 6, 7, 8, 9, 10, 11, 12, 13)  # squares, circles, triangles, diamonds of gnuplot, filled or not; none looks like another


def look(n):
    """Marker, colour and dashes of curve n, from 1 on: no other of 72 has both marker and colour; those of a colour are dashed otherwise."""
    return MARKERS[(n - 1) % len(MARKERS)], COLOURS[n % len(COLOURS)], 1 + (n - 1) // len(COLOURS)


def keep(columns, rows, path):
    """A table, rows by name of the column, as a CSV file."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, columns, extrasaction="ignore")
        table.writeheader()
        table.writerows({c: f"{v:.6g}" if isinstance(v, float) else v for c, v in row.items()} for row in rows)


def show(columns, rows):
    """The same on the terminal."""
    lines = [columns] + [tuple(f"{row[c]:.3g}" if isinstance(row[c], float) else str(row[c]) for c in columns) for row in rows]
    widths = [max(len(line[k]) for line in lines) for k in range(len(columns))]
    for line in lines:
        print("  ".join(text.rjust(width) if k else text.ljust(width)
                        for k, (text, width) in enumerate(zip(line, widths))).rstrip())


def draw(series, path, title, labels):
    """Lines of points on logarithmic axes, a line per name; nothing without gnuplot."""
    if not shutil.which("gnuplot"):
        return
    series = {name: points for name, points in series.items() if points}
    blocks = "".join(f"$d{n} << E\n" + "".join(f"{x:.5e} {y:.5e}\n" for x, y in points) + "E\n"
                     for n, points in enumerate(series.values(), 1))
    curves = ", ".join("$d{} using 1:2 with linespoints lw 2 ps 1.1 pt {} lc rgb '{}' dt {} title '{}'".format(n, *look(n), name)
                       for n, name in enumerate(series, 1))
    script = f"""set terminal pngcairo size 1000,650 font 'DejaVu Sans,11' noenhanced
set output '{path}'
set logscale xy
set format xy '%g'
set xlabel '{labels[0]}'
set ylabel '{labels[1]}'
set title '{title}'
set grid
set key outside right
{blocks}plot {curves}
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
