"""motion.vtkhdf read by VTK: steps, times, points and data at several times, of decks in the plane and in space, of a file that a kill
left in the midst of a block, and of shapes.

read_motion.py PROGRAM DIRECTORY: runs decks there with the program and exits with 1 if something is wrong.
"""

import pathlib
import shutil
import subprocess
import sys

import h5py
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy
from vtk.vtkIOHDF import vtkHDFReader

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class Motion:
    """A file, read by VTK."""

    def __init__(self, path):
        self.reader = vtkHDFReader()
        assert self.reader.CanReadFile(str(path)), f"VTK cannot read {path}"
        self.reader.SetFileName(str(path))
        self.reader.UpdateInformation()
        key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        info = self.reader.GetOutputInformation(0)
        self.times = np.array([info.Get(key, k) for k in range(info.Length(key))])

    def at(self, time):
        """Points, data at points, data at cells, and the numbers of cells by kind, at a time."""
        self.reader.UpdateTimeStep(time)
        data = self.reader.GetOutput()
        assert data.IsA("vtkPolyData")
        arrays = [
            {where.GetArrayName(k): vtk_to_numpy(where.GetArray(k)).copy() for k in range(where.GetNumberOfArrays())}
            for where in (data.GetPointData(), data.GetCellData())
        ]
        cells = data.GetNumberOfVerts(), data.GetNumberOfLines(), data.GetNumberOfPolys(), data.GetNumberOfStrips()
        return vtk_to_numpy(data.GetPoints().GetData()).copy(), *arrays, cells


def run(program, directory, name, **changes):
    """A deck of inputs/ with the file asked for; the paths of the file and of run.h5."""
    text = (ROOT / "inputs" / f"{name}.deck").read_text(encoding="utf-8")
    if "motion" not in text.split("[output]", 1)[1]:
        text = text.replace("[output]\n", "[output]\nmotion = vtkhdf\n")
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    deck = directory / f"{name}.deck"
    deck.write_text(text, encoding="utf-8")
    out = directory / name
    subprocess.run([program, "run", deck, "--out", out, "--quiet"], check=True, timeout=300)
    return out / "motion.vtkhdf", out / "run.h5"


def check_steps(path, run_file, rods):
    """All steps of a deck: times are output instants, points and data as stored, contact forces those of run.h5; rods keep their lengths."""
    motion = Motion(path)
    with h5py.File(run_file) as file, h5py.File(path) as plain:
        times = file["time"][:][file["row_kind"][:] == 0]
        assert np.array_equal(motion.times, times), f"{len(motion.times)} steps, {len(times)} instants"
        n = int(plain["VTKHDF/NumberOfPoints"][0])
        stored = plain["VTKHDF/Points"]
        for step in np.unique(np.linspace(0, len(times) - 1, 7).astype(int)):
            points, at_points, at_cells, cells = motion.at(times[step])
            assert np.array_equal(points, stored[step * n : (step + 1) * n]), f"points at {times[step]}"
            for name in ("velocity", "normal_force", "penetration", "state"):
                rows = plain["VTKHDF/PointData"][name][step * n : (step + 1) * n]
                assert np.array_equal(at_points[name], rows), f"{name} at {times[step]}"
            assert len(at_cells["body"]) == sum(cells) == len(at_cells["contact"])
            if "clearances/contacts/normal_force" in file:
                row = np.flatnonzero(file["row_kind"][:] == 0)[step]
                forces = file["clearances/contacts/normal_force"][row]
                assert np.array_equal(at_points["normal_force"][n - len(forces) :], forces)
            for (i, j), length in rods.items():
                assert abs(np.linalg.norm(points[j] - points[i]) - length) < 1e-9, (times[step], i, j)
    return motion


def check_killed(path):
    """Files as a kill leaves them: datasets with rows of a block of which there are no times yet, and NSteps before or after it grew."""
    whole = Motion(path)
    for n, told in ((2, 2), (2, 130), (1200, 1200), (1200, 1328)):  # of one step VTK makes no series
        part = path.with_name(f"part_{n}_{told}.vtkhdf")
        shutil.copy(path, part)
        with h5py.File(part, "r+") as file:
            file["VTKHDF/Steps/Values"].resize((n,))
            file["VTKHDF/Steps"].attrs.modify("NSteps", np.int64(told))
        motion = Motion(part)
        assert motion.reader.GetNumberOfSteps() == told, (n, motion.reader.GetNumberOfSteps())
        assert np.array_equal(motion.times[:n], whole.times[:n]), (n, len(motion.times))
        for time in motion.times[1 : min(n, 3)]:
            points = motion.at(time)[0]
            assert told > n or np.array_equal(points, whole.at(time)[0])


def main(program, directory):
    """All checks."""
    directory.mkdir(parents=True, exist_ok=True)
    path, run_file = run(program, directory, "slider_crank_dry")
    motion = check_steps(path, run_file, {(0, 1): 0.05, (2, 3): 0.12})
    speed = 5000 * 2 * np.pi / 60
    for time in motion.times[:: len(motion.times) // 11]:  # the tip of a crank that is driven at this speed
        tip = motion.at(time)[0][1]
        assert np.allclose(tip, [0.05 * np.cos(speed * time), 0.05 * np.sin(speed * time), 0], atol=1e-10), time
    check_killed(path)
    check_steps(*run(program, directory, "four_bar_spatial"), {(0, 1): 0.02})
    check_steps(*run(program, directory, "double_pendulum"), {})
    check_steps(*run(program, directory, "four_bar_kinematic"), {})
    print(f"vtk-test: all as expected, read by VTK {vtk.vtkVersion().GetVTKVersion()}")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
