"""Pages of animations: their numbers against run.h5, their size, thinning, and the picture in a browser without WebGL's help."""

import functools
import re

import h5py
import numpy as np
import pytest
from page_data import page_data, rotation_of
from support import DECK, ROOT, call, changed, scratch, written
from test_motion_file import CRANK

LIMIT = 5_000_000  # bytes of a page


def page_of(gudgeon, text, figures, *options):
    """Run a deck's text with figures; the page of its animation and run.h5."""
    directory = scratch()
    call(gudgeon, "run", written(directory, changed(text, "output", figures=figures, channels=None)), "--out", directory / "run", "--quiet", *options)
    (page,) = (directory / "run" / "figures").glob("animation*.html")
    return page, directory / "run" / "run.h5"


@functools.lru_cache(maxsize=None)
def crank_page(gudgeon):
    """A part of a turn of the slider-crank with clearance."""
    text = changed(DECK.read_text(encoding="utf-8"), "analysis.dynamic", end="4 ms")
    return page_of(gudgeon, text, "animation(n=20, last=3ms) slider.velocity energy.kinetic gudgeon.force")


@functools.lru_cache(maxsize=None)
def spatial_page(gudgeon):
    """A part of the motion of the four-bar in space."""
    text = changed((ROOT / "inputs" / "four_bar_spatial.deck").read_text(encoding="utf-8"), "analysis.dynamic", end="100 ms")
    return page_of(gudgeon, text, "animation(n=20)")


def rows_at(times, wanted):
    """Rows at output times nearest to those wanted, which must be output times."""
    rows = np.array([np.argmin(abs(times - t)) for t in wanted])
    np.testing.assert_allclose(times[rows], wanted, atol=1e-12)
    return rows


@pytest.mark.parametrize("make", [crank_page, spatial_page])
def test_positions_are_those_of_the_run(gudgeon, make):
    """Places and turns of all bodies to single precision; the ground stands."""
    page, results = make(gudgeon)
    data = page_data(page)
    with h5py.File(results) as file:
        rows = rows_at(file["time"][:], data["t"])
        place = file["bodies/position"][:][rows]
        names = [name.decode() for name in file["bodies/names"][:]]
        if data["spatial"]:
            p = file["bodies/orientation"][:][rows]
            turn = rotation_of(np.concatenate([p[..., 1:], p[..., :1]], axis=-1))
        else:
            angle = file["bodies/angle"][:][rows]
            turn = rotation_of(np.stack([0 * angle, 0 * angle, np.sin(angle / 2), np.cos(angle / 2)], axis=-1))
            place = np.concatenate([place, 0 * place[..., :1]], axis=-1)
    assert data["bodies"] == ["ground", *names] and len(data["t"]) == 20
    np.testing.assert_allclose(data["r"][:, 1:], place, rtol=1e-7, atol=1e-9)
    np.testing.assert_allclose(rotation_of(data["q"][:, 1:]), turn, atol=4e-7)
    assert not data["r"][:, 0].any() and (data["q"][:, 0] == [0, 0, 0, 1]).all()


def test_forces_and_eccentricities_are_those_of_the_run(gudgeon):
    """Arrow and magnified journal go by rows of the run, contacts among them, not by positions."""
    page, results = crank_page(gudgeon)
    data = page_data(page)
    with h5py.File(results) as file:
        times, force = file["time"][:], file["clearances/force"][:, 0, :2]
        eccentricity = file["clearances/eccentricity"][:, 0, :2]
    inside = (times >= data["t"][0] - 1e-12) & (times <= data["t"][-1] + 1e-12)
    track = data["track"]
    assert inside.sum() == len(track["t"]) > 10 * len(data["t"])
    np.testing.assert_allclose(track["t"], times[inside], atol=1e-15)
    np.testing.assert_allclose(track["f"][0][:, :2], force[inside], rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(track["e"][0][:, :2], eccentricity[inside], rtol=1e-6, atol=1e-12)


def test_plots_keep_the_extremes(gudgeon):
    """Every point of a plot is a row of the run, and no peak over the window is lost."""
    page, results = crank_page(gudgeon)
    data = page_data(page)
    assert [plot["title"] for plot in data["plots"]] == ["slider.velocity", "energy.kinetic", "gudgeon.force"]
    assert [plot["unit"] for plot in data["plots"]] == ["m/s", "J", "kN"]
    (curve,) = data["plots"][0]["curves"]
    with h5py.File(results) as file:
        names = [name.decode() for name in file["bodies/names"][:]]
        times, speed = file["time"][:], file["bodies/velocity"][:, names.index("slider"), 0]
    assert curve["n"] == "slider.velocity.x" and len(curve["x"]) > 100 and np.all(np.diff(curve["x"]) >= 0)
    for t, v in zip(curve["x"], curve["y"]):
        assert min(abs(speed[abs(times - t) < 1e-12] - v)) < 1e-6 * abs(speed).max()
    inside = speed[(times >= data["t"][0]) & (times <= data["t"][-1])]
    np.testing.assert_allclose([curve["y"].min(), curve["y"].max()], [inside.min(), inside.max()], rtol=1e-6)


def test_a_page_stays_below_its_limit(gudgeon, monkeypatch, tmp_path):
    """200 positions of 700 bodies do not fit: every second stays, at its place, and the page says so."""
    rows = "\n".join(f"b{k} 1 1 {k}" for k in range(700))
    points = "\n".join(f"p{k} b{k} 0.1" for k in range(700))
    text = f"deck = 1\n[scene]\ntitle = \"many\"\ngravity = 0 -9.81 m/s^2\n[bodies]\nname mass[kg] inertia[kg.m^2] x[m]\n{rows}\n[points]\nname body xi[m]\n{points}\n" \
        "[analysis.dynamic]\nend = 199 ms\nmethod = verner\n[output]\nevery = 1 ms\n"
    monkeypatch.setenv("PATH", str(tmp_path))  # without gnuplot: the page is what is looked at
    page, _ = page_of(gudgeon, text, "animation(n=200, last=199ms)")
    data = page_data(page)
    assert LIMIT / 2 < page.stat().st_size < LIMIT
    stride = int(re.search(r"Every ([0-9]+)\. of 200 positions", data["note"]).group(1))
    np.testing.assert_allclose(data["t"], 1e-3 * np.arange(0, 200, stride), atol=1e-9)
    np.testing.assert_allclose(data["r"][:, 700, 1], -0.5 * 9.81 * data["t"] ** 2, atol=1e-6)
    np.testing.assert_allclose(data["r"][-1, 1:, 0], np.arange(700), rtol=1e-6)


def test_a_page_asks_for_nothing(gudgeon):
    """No address, no import, no source but what stands in the page, outside of the library."""
    page, _ = crank_page(gudgeon)
    text = page.read_text(encoding="utf-8")
    own = re.sub(r"(?s)<script>(?!const D|\s*const D).*?</script>|<!--.*?-->", "", text)
    assert "Copyright (c) 2010-2019 three.js authors" in text and text.count("<script>") == 3
    assert not re.search(r"(src|href) *=|@import|fetch\(|XMLHttp|import\(|url\(", own)
    assert set(re.findall(r"https?://[^'\"` ]*", own)) == {"http://www.w3.org/2000/svg"}  # the name of SVG, not an address


CUBE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
SIDES = [[1, 4, 3, 2], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]]  # of the cube, outward, from 1
TETRAHEDRON = [[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 5]]
FACES = [[1, 3, 2], [1, 2, 4], [2, 3, 4], [3, 1, 4]]


def triangles(points, faces):
    """Corners of the triangles of polygons."""
    return np.array([[points[f[0] - 1], points[f[k] - 1], points[f[k + 1] - 1]] for f in faces for k in range(1, len(f) - 1)], "<f4")


def text_stl(list_of):
    """STL as text."""
    lines = ["solid thing"]
    for corners in list_of:
        lines += ["  facet normal 0 0 0", "    outer loop", *(f"      vertex {x:g} {y:e} {z:g}" for x, y, z in corners), "    endloop",
                  "  endfacet"]
    return ("\r\n".join([*lines, "endsolid thing"]) + "\r\n").encode()


def binary_stl(list_of):
    """STL as bytes; its header begins like that of text, as those of some programs do."""
    facets = b"".join(np.zeros(3, "<f4").tobytes() + np.array(corners, "<f4").tobytes() + b"\0\0" for corners in list_of)
    return b"solid by a program".ljust(80) + len(list_of).to_bytes(4, "little") + facets


def obj(points, faces):
    """OBJ with normals and textures that are not there, one face counted from the end."""
    lines = ["# a comment", "mtllib none.mtl", "o thing", *(f"v {x} {y} {z}" for x, y, z in points), "vn 0 0 1", "usemtl none"]
    lines += ["f " + " ".join(f"{v}/1/1" for v in face) for face in faces[:-1]]
    return ("\n".join([*lines, "f " + " ".join(f"{v - len(points) - 1}//1" for v in faces[-1])]) + "\n").encode()


def mesh_deck(name, columns="", cells="", space="planar"):
    """A crank drawn by a mesh."""
    return CRANK.replace("[bodies]", f"[shapes]\nname body shape file{columns}\nbob crank mesh {name}{cells}\n[bodies]") \
        .replace("motion = vtkhdf", "figures = animation(n=2)").replace("end = 1 s", "end = 100 ms")


@pytest.mark.parametrize(("name", "content", "volume"), [
    ("cube.stl", text_stl(triangles(CUBE, SIDES)), 1.0), ("cube.STL", binary_stl(triangles(CUBE, SIDES)), 1.0),
    ("cube.obj", obj(CUBE, SIDES), 1.0), ("tetrahedron.stl", binary_stl(triangles(TETRAHEDRON, FACES)), 5.0),
    ("tetrahedron.obj", obj(TETRAHEDRON, FACES), 5.0)],
    ids=["text", "bytes", "obj", "tetrahedron", "tetrahedron_obj"])
def test_meshes_have_their_volume(gudgeon, tmp_path, name, content, volume):
    """Volume and centroid of a cube and of a tetrahedron by the divergence theorem, in their unit and at their place."""
    (tmp_path / name).write_bytes(content)
    deck = written(tmp_path, mesh_deck(name, " file_unit xi[m] eta[m] angle[deg]", " 20mm 0.1 0.2 90"))
    call(gudgeon, "run", deck, "--out", tmp_path / "run", "--quiet")
    (part,) = (p for p in page_data(tmp_path / "run" / "figures" / "animation.n.2.html")["parts"] if "t" in p)
    n_vertex = 8 if "cube" in name else 4
    assert part["b"] == 1 and len(part["s"]) == n_vertex and len(part["t"]) == (12 if "cube" in name else 4)
    a, b, c = np.moveaxis(part["s"].astype(float)[part["t"]], 1, 0)
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    np.testing.assert_allclose(volumes.sum(), volume * 0.02**3, rtol=1e-6)
    centroid = np.einsum("i,ij->j", volumes, (a + b + c) / 4) / volumes.sum()
    own = np.array([0.5, 0.5, 0.5]) if "cube" in name else np.array([2, 3, 5]) / 4
    np.testing.assert_allclose(centroid, [0.1 - 0.02 * own[1], 0.2 + 0.02 * own[0], 0.02 * own[2]], atol=1e-7)


def test_edges_of_a_cube_are_drawn(gudgeon, tmp_path):
    """In flat pictures the cube has its 12 edges, not the diagonals of its sides."""
    (tmp_path / "cube.stl").write_bytes(binary_stl(triangles(CUBE, SIDES)))
    text = mesh_deck("cube.stl", " file_unit", " 100mm").replace("animation(n=2)", "mechanism(t=0s)")
    call(gudgeon, "run", written(tmp_path, text), "--out", tmp_path / "run", "--quiet")
    lines = [block for block in (tmp_path / "run" / "figures" / "mechanism.t.0s.dat").read_text().split("\n\n\n")[2].split("\n\n") if block.strip()]
    assert len(lines) == 12


BAD = {
    "no_triangles.stl": (b"solid\nendsolid\n", "no triangles"),
    "nan.stl": (text_stl(triangles(CUBE, SIDES)).replace(b"vertex 1", b"vertex nan", 1), "nan.stl:6: not a finite number: 'nan'"),
    "infinite.stl": (binary_stl(np.full((1, 3, 3), np.inf, "<f4")), "triangle 1 has a coordinate that is not finite"),
    "two.stl": (b"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n", "two.stl:7: a facet has three"),
    "four.stl": (b"solid\nfacet\nouter loop\n" + 4 * b"vertex 0 0 0\n" + b"endloop\nendfacet\n", "four.stl:7: a fourth vertex"),
    "cut.stl": (b"solid\nfacet\nouter loop\nvertex 0 0 0\n", "ends within a facet"),
    "flat.stl": (b"solid\nfacet\nouter loop\nvertex 0 0\n", "flat.stl:4: a vertex has three coordinates, here 2"),
    "html.stl": (b"solid\n<html>\n", "html.stl:2: not a line of STL"),
    "picture.stl": (b"\x89PNG" + bytes(range(256)), "not an STL file"),
    "huge.stl": (binary_stl(triangles(CUBE, SIDES))[:80] + b"\xff\xff\xff\xff" + bytes(100), "do not hold the number of triangles"),
    "many.stl": (bytes(80) + (50001).to_bytes(4, "little") + bytes(50 * 50001), "50001 triangles or more (allowed 50000)"),
    "none.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no triangles"),
    "far.obj": (b"v 0 0 0\nv 1 0 0\nf 1 2 3\nv 0 1 0\n", "far.obj:3: '3' is none of the 2 vertices before this line"),
    "zero.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "zero.obj:4: '0' is none of the 3"),
    "word.obj": (b"v 0 0 x\n", "word.obj:1: not a finite number: 'x'"),
    "line.obj": (b"v 0 0 0\nv 1 0 0\nf 1 2\n", "line.obj:3: a face has at least three corners, here 2"),
    "range.obj": (b"v 0 0 1e999\n", "range.obj:1: not a finite number: '1e999'"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_meshes_are_named(gudgeon, tmp_path, name):
    """What is wrong in a file, with its line; the deck is refused."""
    content, words = BAD[name]
    (tmp_path / name).write_bytes(content)
    message = call(gudgeon, "check", written(tmp_path, mesh_deck(name)), expect=3).stderr
    assert words in message and name in message and "column file of shapes" in message


@pytest.mark.parametrize(("deck", "words"), [
    (mesh_deck("gone.stl"), "no such file"), (mesh_deck("."), "it is a directory"),
    (mesh_deck("x").replace("crank mesh x", "crank mesh -"), "needs an STL or OBJ file"),
    (mesh_deck("cube.stl").replace("crank mesh", "crank box"), "a box has no file: write shape mesh"),
    (mesh_deck("cube.stl", " file_unit", " 0mm"), "file_unit"),
    (mesh_deck("half.stl").replace("[bodies]", "[shapes]\nname body shape file\nmore crank mesh half.stl\n[bodies]", 1), "have 60000 triangles (allowed 50000)")],
    ids=["gone", "directory", "no_file", "box", "unit", "too_many"])
def test_rows_of_meshes_are_checked(gudgeon, tmp_path, deck, words):
    """A missing file, a file of another shape, a unit of no length, more triangles than a page holds."""
    (tmp_path / "cube.stl").write_bytes(binary_stl(triangles(CUBE, SIDES)))
    (tmp_path / "half.stl").write_bytes(binary_stl(np.zeros((30000, 3, 3), "<f4")))
    assert words in call(gudgeon, "check", written(tmp_path, deck), expect=3).stderr
