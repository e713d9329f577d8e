"""Oceans and questions, and what `earshot field` writes of them.

Used as a module by the tests of fields, fans and files beside it, and by field_sweep.
"""

import ctypes
import ctypes.util
import subprocess
from pathlib import Path
from typing import Any

import numpy as np

import earshot

_NETCDF = ctypes.CDLL(ctypes.util.find_library("netcdf") or "libnetcdf.so.19")


def read_netcdf(file, name, kind, size):
    """A variable of a NetCDF file by the C library itself: no package of ours or of Python's stands between."""
    identity, variable = ctypes.c_int(), ctypes.c_int()
    assert _NETCDF.nc_open(str(file).encode(), 0, ctypes.byref(identity)) == 0
    assert _NETCDF.nc_inq_varid(identity, name.encode(), ctypes.byref(variable)) == 0
    dimensions = (ctypes.c_int * 8)()
    count, length, sizes = ctypes.c_int(), ctypes.c_size_t(), []
    assert _NETCDF.nc_inq_varndims(identity, variable, ctypes.byref(count)) == 0
    assert _NETCDF.nc_inq_vardimid(identity, variable, dimensions) == 0
    for dimension in dimensions[: count.value]:
        assert _NETCDF.nc_inq_dimlen(identity, dimension, ctypes.byref(length)) == 0
        sizes.append(length.value)
    values = np.empty(size, kind)
    assert values.size == np.prod(sizes), f"{name} of {file} is {sizes}, not {size}"
    read = {np.float32: _NETCDF.nc_get_var_float, np.float64: _NETCDF.nc_get_var_double}[kind]
    assert read(identity, variable, values.ctypes.data_as(ctypes.c_void_p)) == 0
    assert _NETCDF.nc_close(identity) == 0
    return values


def length_in_netcdf(file, dimension):
    """Of a dimension, likewise."""
    identity, number, length = ctypes.c_int(), ctypes.c_int(), ctypes.c_size_t()
    assert _NETCDF.nc_open(str(file).encode(), 0, ctypes.byref(identity)) == 0
    assert _NETCDF.nc_inq_dimid(identity, dimension.encode(), ctypes.byref(number)) == 0
    assert _NETCDF.nc_inq_dimlen(identity, number, ctypes.byref(length)) == 0
    assert _NETCDF.nc_close(identity) == 0
    return length.value


def run_program(programs, *arguments):
    """`earshot field` with these arguments."""
    command = [str(Path(programs) / "earshot-field"), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def require_written(file, dataset, names):
    """Asserts that variables of a Dataset have the bits of the file's. `names` may map a file's name to ours."""
    for name in names:
        values = np.atleast_1d(dataset[names[name] if isinstance(names, dict) else name].values)
        kind = np.float64 if values.dtype == np.float64 else np.float32
        written = read_netcdf(file, name, kind, values.shape)
        np.testing.assert_array_equal(values.view(np.uint8), written.view(np.uint8), err_msg=name)


def write_hilly_ocean(folder):
    """An ocean 2500 m deep with an island 7 km in the east; its chart reaches 22 km. Returns its file."""
    lines = ["latitude_deg,longitude_deg,elevation_m"]
    for i in range(-10, 11):
        for j in range(-10, 11):
            island = 3_600.0 * np.exp(-((2.2 * j - 7.0) ** 2 + (2.2 * i) ** 2) / 4.0)
            lines.append(f"{0.02 * i:.2f},{0.02 * j:.2f},{island - 2_500.0:.3f}")
    (folder / "chart.csv").write_text("\n".join(lines) + "\n")
    text = Path(__file__).resolve().parents[2].joinpath("sim/sonar/hilly.toml").read_text()
    (folder / "hilly.toml").write_text(text)
    return folder / "hilly.toml"


def random_ocean(rng):
    """Keyword arguments of an Environment, shallow or deep, of every form that there is."""
    floor = float(rng.choice([60.0, 200.0, 1_000.0, 3_000.0]) * rng.uniform(0.8, 1.2))
    depth = np.concatenate([[0.0], np.sort(rng.uniform(1.0, floor, rng.integers(1, 6))), [1.3 * floor]])
    speed = 1_500.0 + rng.uniform(-15.0, 25.0, depth.size)
    shape = rng.integers(4)
    sound_speed: Any
    if shape == 0:
        sound_speed = float(rng.uniform(1_480.0, 1_520.0))
    elif shape == 1:
        sound_speed = (depth, speed)
    elif shape == 2:
        sound_speed = ([0.0, 700.0], depth, np.stack([speed, speed + rng.uniform(-3.0, 3.0, depth.size)]))
    else:
        sound_speed = earshot.Munk(axis_depth=0.4 * floor, scale=0.4 * floor)
    bathymetry = floor if rng.random() < 0.5 else ([0.0, 400.0, 1_500.0], floor * rng.uniform(0.85, 1.0, 3))
    mud = earshot.Layer(
        rng.uniform(1_450.0, 1_600.0),
        density=rng.uniform(1.2, 1.7),
        thickness=rng.uniform(2.0, 20.0),
        sound_speed_at_base=rng.uniform(1_500.0, 1_650.0),
    )
    sand = earshot.Layer(
        rng.uniform(1_550.0, 1_800.0), density=rng.uniform(1.5, 2.1), attenuation=rng.uniform(0.1, 0.9)
    )
    sediment = [sand, [mud, sand], {0.0: [sand], 600.0: [mud, sand]}][rng.integers(3)]
    absorbing = earshot.SeaWater(temperature=rng.uniform(2.0, 20.0), salinity=35.0, depth=30.0)
    return {
        "sound_speed": sound_speed,
        "bathymetry": bathymetry,
        "sediment": sediment,
        "absorption": absorbing if rng.random() < 0.5 else None,
        "source_level": float(rng.uniform(140.0, 200.0)),
        "noise_level": float(rng.uniform(60.0, 100.0)),
        "frequency": float(rng.uniform(10.0, 60.0) * 3_000.0 / (floor + 2_000.0)),
        "source_depth": float(rng.uniform(0.05, 0.8) * floor),
    }


def random_question(rng):
    """Keyword arguments of field, and the options of the program that say the same."""
    question: dict[str, Any] = {
        "max_range": float(rng.uniform(200.0, 2_500.0)),
        "accuracy_db": float(rng.choice([0.02, 0.1, 0.5])),
    }
    if rng.random() < 0.5:
        question["receiver_depth"] = np.sort(rng.uniform(1.0, 45.0, rng.integers(1, 5)))
    if rng.random() < 0.3:
        question["output_step"] = float(rng.uniform(5.0, 40.0))
    if rng.random() < 0.2:
        question["starter"] = "gaussian"
    if rng.random() < 0.2:
        question["depth_step"] = 0.5
    options = []
    for name, option in (
        ("accuracy_db", "--accuracy-db"),
        ("output_step", "--output-step-m"),
        ("starter", "--starter"),
        ("depth_step", "--depth-step"),
    ):
        if name in question:
            options += [option, str(question[name])]
    # repr() of a thousandth need not be the thousandth part's number; a division by 1000 here is undone there.
    question["max_range"] = 1000.0 * (question["max_range"] / 1000.0)
    options += ["--max-range-km", repr(question["max_range"] / 1000.0)]
    if "receiver_depth" in question:
        options += ["--depth", *map(repr, question["receiver_depth"].tolist())]
    return question, options


def require_same(programs, folder, ocean, question, options, frequency=None, source_depth=None):
    """Asserts that Python and the program give the same bits; where one refuses, the other must, too."""
    environment = earshot.Environment(**ocean)
    asked = {**ocean}
    if frequency is not None:
        asked["frequency"] = frequency
    if source_depth is not None:
        asked["source_depth"] = source_depth
    (folder / "ocean.toml").write_text(earshot.Environment(**asked).to_toml())
    file = folder / "field.nc"
    file.unlink(missing_ok=True)
    done = run_program(programs, folder / "ocean.toml", "-o", file, *options)
    try:
        sound = earshot.field(environment, frequency=frequency, source_depth=source_depth, **question)
    except earshot.BadInput as bad:
        assert done.returncode == 2, f"Python refuses what the program takes: {bad}"
        return False
    assert done.returncode == 0, done.stderr
    require_written(file, sound, ["range", "depth", "transmission_loss", "snr", "sea_floor_depth"])
    return True
