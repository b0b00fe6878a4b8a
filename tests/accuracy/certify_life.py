#!/usr/bin/env python3
"""Certification of `gudgeon life`: whether the intervals of random decks hold what ten times finer jumps give.

certify_life.py --build DIRECTORY [-n 100] [--first 0] [--seed 1] [--jobs 2] [--limit 600]

Slider-cranks and four-bars with a dry joint that wears, from regular to chaotic motion. Truth is the same life with a tolerance a hundred
times smaller, which is ten times finer jumps of a method of second order; with an ensemble it has ten times as many starts too. The
interval of depth and volume of each surface at the end must hold the truth within its own interval. The exit code is 1 if fewer than
90 % of the decks do.
"""

import argparse
import concurrent.futures
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

WANTED = 0.9  # part of the decks that must hold
MEASURES = ("depth_max", "volume")
DECK = """deck = 1
[scene]
title = "random life {number}"
gravity = 0 -9.81 m/s^2
{mechanism}
[material]
name    young[GPa]   poisson   density[kg/m^3]
steel   207          0.3       7850
[clearance.revolute]
name    bearing     journal     bearing_radius[mm]   clearance[mm]   length[mm]   material   law   friction   wear
joint   {bearing}   {journal}   10                   {clearance}     15           steel      dry   rough      slow
[contact.lankarani_nikravesh]
name   restitution
dry    {restitution}
[friction.ambrosio]
name    coefficient   v0[m/s]   v1[m/s]
rough   {friction}    1e-4      1e-3
[wear.archard]
name   bearing[m^2/N]   journal[m^2/N]   cells
slow   {bearing_k}      {journal_k}      {cells}
[driver.speed]
name    joint   speed[rpm]
motor   main    {speed}
[analysis.dynamic]
start = ideal
end   = 1 turns of motor
tolerance = 1e-7
{ensemble}
[life]
cycle     = 1 turns of motor
settle    = {settle}
cycles    = {cycles}
tolerance = {tolerance}
"""
SLIDER_CRANK = """[bodies]
name     mass[kg]   inertia[kg.m^2]   x[mm]
crank    0.30       1.0e-4            {half_crank}
rod      {rod}      2.5e-4            {middle}
slider   {slider}   1.0e-4            {end}
[points]
name     body     xi[mm]
main     ground     0
heel     crank    {minus_crank}
throw    crank     {half_crank}
big      rod      {minus_rod}
small    rod       {half_rod}
pin      slider     0
[joint.revolute]
name        i       j
main        main    heel
big_end     throw   big
[joint.translational]
name     i        j        axis
guide    main     pin      x"""
FOUR_BAR = """[bodies]
name      mass[kg]   inertia[kg.m^2]   x[mm]        y[mm]      angle[deg]
crank     0.30       1.0e-4            0            {half_crank}   90
coupler   {rod}      1.0e-3            {coupler_x}  {coupler_y}    {coupler_angle}
rocker    {slider}   1.0e-3            {rocker_x}   {rocker_y}     {rocker_angle}
[points]
name     body      xi[mm]
main     ground    0
foot     ground    {base}
heel     crank     {minus_crank}
throw    crank     {half_crank}
big      coupler   {minus_rod}
small    coupler   {half_rod}
low      rocker    {minus_rocker}
pin      rocker    {half_rocker}
[joint.revolute]
name        i       j
main        main    heel
big_end     throw   big
foot        foot    low"""


def circles(base, crank, coupler, rocker):
    """The upper place where coupler and rocker meet, the crank upright."""
    x, y = base, -crank
    distance = (x * x + y * y) ** 0.5
    along = (coupler**2 - rocker**2 + distance**2) / (2 * distance)
    across = (coupler**2 - along**2) ** 0.5
    return (along * x - across * y) / distance, crank + (along * y + across * x) / distance


def mechanism(draw, is_crank):
    """Words of a mechanism, bearing and journal."""
    crank, rod = draw.uniform(30, 60), draw.uniform(110, 160)
    words = {"half_crank": crank / 2, "minus_crank": -crank / 2, "half_rod": rod / 2, "minus_rod": -rod / 2,
             "rod": draw.uniform(0.1, 0.4), "slider": draw.uniform(0.1, 0.4), "middle": crank + rod / 2, "end": crank + rod}
    if is_crank:
        return SLIDER_CRANK.format(**words), "pin", "small"
    base, rocker = 1.1 * rod, draw.uniform(0.7, 0.9) * rod
    x, y = circles(base, crank, rod, rocker)
    words |= {"base": base, "coupler_x": x / 2, "coupler_y": (crank + y) / 2, "rocker_x": (x + base) / 2, "rocker_y": y / 2,
              "coupler_angle": math.degrees(math.atan2(y - crank, x)), "rocker_angle": math.degrees(math.atan2(y, x - base)),
              "minus_rocker": -rocker / 2, "half_rocker": rocker / 2}
    return FOUR_BAR.format(**words), "pin", "small"


def deck_of(number, seed, finer=False):
    """A random deck, or the one of its truth."""
    draw = random.Random(f"{seed} {number}")
    words = {"number": number}
    words["mechanism"], words["bearing"], words["journal"] = mechanism(draw, number % 2 == 0)
    words["clearance"] = round(10 ** draw.uniform(-2, -0.7), 4)
    words["restitution"] = round(draw.uniform(0.3, 0.9), 3)
    words["friction"] = round(draw.uniform(0.02, 0.2), 3)
    words["speed"] = round(10 ** draw.uniform(2, 3.5), 1)
    words["bearing_k"], words["journal_k"] = draw.choice([("1e-14", "1e-14"), ("1e-14", "0"), ("0", "1e-14"), ("3e-14", "1e-14")])
    words["cells"] = 90
    words["settle"] = draw.choice([1, 2])
    words["cycles"] = round(10 ** draw.uniform(1.5, 3))
    tolerance = 10 ** draw.uniform(-2.3, -1.3)
    starts = draw.choice([1, 4, 4, 4])
    if finer:
        tolerance, starts = tolerance / 100, starts * 10 if starts > 1 else 1
    words["tolerance"] = tolerance
    words["ensemble"] = f"[ensemble]\nruns = {starts}\nposition = 10 um\nvelocity = 0.1 m/s" if starts > 1 else ""
    return DECK.format(**words)


def measures(program, text, limit):
    """Depth and volume of both surfaces with their intervals; None where the life failed."""
    with tempfile.TemporaryDirectory() as place:
        deck = pathlib.Path(place) / "life.deck"
        deck.write_text(text)
        command = [program, "life", deck, "--out", f"{place}/out", "--quiet", "--jobs", "1"]
        try:
            said = subprocess.run(command, capture_output=True, text=True, timeout=limit, check=False)
        except subprocess.TimeoutExpired:
            return None, f"more than {limit} s"
        if said.returncode != 0:
            return None, said.stderr.splitlines()[0] if said.stderr else f"exit code {said.returncode}"
        wear = json.loads((pathlib.Path(place) / "out/summary.json").read_text())["wear"]["joint"]
    return {(side, name): wear[side][name] for side in ("bearing", "journal") for name in MEASURES}, ""


def judge(program, number, seed, limit):
    """The verdict on a deck: holds, misses or unknown, and why."""
    claim, why = measures(program, deck_of(number, seed), limit)
    if claim is None:
        return "unknown", f"claim: {why}"
    truth, why = measures(program, deck_of(number, seed, finer=True), 10 * limit)
    if truth is None:
        return "unknown", f"truth: {why}"
    worst, where = 0.0, ""
    for key, asked in claim.items():
        known = truth[key]
        room = ((asked["high"] - asked["low"]) ** 2 + (known["high"] - known["low"]) ** 2) ** 0.5 / 2
        off = abs(asked["value"] - known["value"])
        if off > 0 and off > worst * room:
            worst, where = off / room if room > 0 else float("inf"), " ".join(key)
    return "holds" if worst <= 1 else "misses", f"{worst:.2g} of the interval, {where}"


def main():
    """Judge decks, say what came of them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build")
    parser.add_argument("-n", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--limit", type=float, default=600, help="seconds for a life, ten times as many for its truth")
    parser.add_argument("--deck", type=int, help="print this deck only")
    asked = parser.parse_args()
    if asked.deck is not None:
        print(deck_of(asked.deck, asked.seed))
        return 0
    counts = {"holds": 0, "misses": 0, "unknown": 0}
    program = pathlib.Path(asked.build).resolve() / "gudgeon"
    numbers = range(asked.first, asked.first + asked.n)
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        verdicts = pool.map(lambda number: judge(program, number, asked.seed, asked.limit), numbers)
        for number, (verdict, why) in zip(numbers, verdicts):
            counts[verdict] += 1
            print(f"deck {number:3d} {verdict:8s} {why}", flush=True)
    known = counts["holds"] + counts["misses"]
    print(f"{counts['holds']} of {known} hold, {counts['unknown']} unknown")
    return 0 if known and counts["holds"] >= WANTED * known else 1


if __name__ == "__main__":
    sys.exit(main())
