"""A deck of the plane in space: the same bodies, joints and loose pins, the plane that of x and y."""

import re


def in_space(text):
    """The text of inputs/slider_crank_dry.deck, or of another with the same tables, as a mechanism of space; bodies have their moment about
    all three axes."""
    text = re.sub(r"(?m)^(space\s*=\s*)planar", r"\1spatial", text)
    text = re.sub(r"(?m)^(gravity\s*=\s*\S+ \S+) m/s\^2", r"\1 0 m/s^2", text)

    def body(match):
        name, mass, inertia, x, y, angle = match.groups()
        return f'{name} {mass} {inertia} {inertia} {inertia} {x} {y} "0 0 1" {angle}'

    text = re.sub(r"(?ms)^\[shapes\].*?(?=^\[|\Z)", "", text)  # polygons of the plane
    head, rest = text.split("[bodies]", 1)
    table, rest = rest.split("\n\n", 1)
    table = re.sub(r"(?m)^(\S+) +(\S+) +(\S+) +(\S+) +(\S+) +(\S+)$", body, table)
    table = re.sub(r'(?m)^name .*$', "name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[mm] y[mm] axis angle[deg]", table)
    rest = re.sub(r"(?m)^(name +i +j +)axis( .*)?$", r"\1axis_i", rest)
    rest = re.sub(r"(?m)^(guide .*) x$", r'\1 "1 0 0"', rest)
    return f"{head}[bodies]{table}\n\n{rest}"
