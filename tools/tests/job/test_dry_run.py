"""The dry run against the virtual machine, and its arcs that turn z against a judge."""

import numpy as np
import pytest
from plumb.bench.boards import MAKER
from plumb.firmware.telemetry import telemetry_in
from plumb.job.dry_run import Run, pieces
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation
from workshop import NAMES, PROGRAMS, Workshop, lines_of, run_dry

APART = 0.35  # [mm] between the cut and the way of the dry run; steps of 0.1 mm and following error


@pytest.mark.parametrize("name", NAMES)
def test_time_and_cut_are_those_of_the_virtual_machine(name):
    workshop = Workshop()
    took = workshop.cut(lines_of(name))
    telemetry = telemetry_in("\n".join(workshop.sender.ask("B30")))
    assert (telemetry.slips, telemetry.last_slip) == ((0, 0), None), "no chain seems to slip"
    done = run_dry(lines_of(name))
    assert done.seconds == pytest.approx(took, rel=0.005)
    assert done.halted_at is None and not done.refused
    way = done.moves.sampled(0.1)
    tree = cKDTree(np.column_stack([way.places, way.z]))
    cut = np.array(workshop.machine.cuts())[:, 2:]
    cut[:, 2] *= -1
    off, _ = tree.query(cut)
    assert off.max() < APART
    # And all of the way that is in the wood was cut.
    rises = done.moves["z_to"] > done.moves["z_from"]
    deep = (way.z < -0.1) & ~rises[way.move]
    off, _ = cKDTree(cut).query(np.column_stack([way.places, way.z])[deep])
    assert off.max() < APART


def test_each_program_has_its_places():
    assert len(NAMES) == 13
    for name in NAMES:
        rows = [
            list(map(float, row.split()))
            for row in (PROGRAMS / name).with_suffix(".places").read_text().splitlines()
            if not row.startswith("#")
        ]
        for line, *place in rows:
            run = Run(MAKER)
            run.send(lines_of(name)[: int(line)])
            assert run.place == pytest.approx(place, abs=0.008), (name, line)


def test_an_alarm_ends_the_run():
    run = Run(MAKER)
    run.send(["G0 Z2", "B11 L S100 T1", "G0 X5"])
    assert run.finish().halted_at is None
    run = Run(MAKER, numbers={2: 4000.0})
    assert run.finish().seconds == 0


def test_a_line_is_cut_as_the_firmware_cuts_it():
    assert pieces("n5 g1x2.5 (a) M3 S99;b") == [("G", 1.0, {"X": 2.5}), ("M", 3.0, {"S": 99.0})]
    assert pieces("G38.2 Z-5")[0][1] == pytest.approx(38.2)
    assert pieces("X--5") == [] == pieces("")


NEAR = 0.008  # [mm] from the arc: chords of 0.005 mm, and three decimals in the text
NORMAL = {"G17": (0, 0, 1), "G18": (0, 1, 0), "G19": (1, 0, 0)}
DRAWN = np.random.default_rng(18)


def judged(start, centre, plane, turn, climb):
    """Places of an arc (n, 3) that turns [rad] about the plane's normal by the right hand, and
    climbs [mm] along it.
    """
    shares = np.linspace(0, 1, 2001)[:, None]
    normal = np.array(NORMAL[plane], dtype=float)
    turned = Rotation.from_rotvec(shares * turn * normal).apply(np.subtract(start, centre))
    return centre + turned + shares * climb * normal


def line_of(plane, start, centre, way, *, with_radius):
    """The line for an arc, with the centre or, of less than a turn, the radius."""
    normal = np.array(NORMAL[plane])
    code = "G3" if way.turn > 0 else "G2"
    words = [f"{letter}{value:.3f}" for letter, value in zip("XYZ", way.end, strict=True)]
    ahead = (np.array(centre) - start) * (1 - normal)
    if with_radius:
        size = np.linalg.norm(ahead) * (1 if abs(way.turn) < np.pi else -1)
        words.append(f"R{size:.4f}")
    else:
        letters = zip("IJK", ahead, normal, strict=True)
        words += [f"{letter}{value:.3f}" for letter, value, off in letters if not off]
    return " ".join([plane, code, *words, "F900"])


class Way:
    """A drawn arc: where it begins, its centre, its turn [rad] and climb [mm]."""

    def __init__(self, plane):
        self.start = np.round(DRAWN.uniform((-60, -60, 2), (60, 60, 20)), 3)
        across = DRAWN.normal(size=3) * (1 - np.array(NORMAL[plane]))
        across *= DRAWN.uniform(0.5, 25) / np.linalg.norm(across)
        self.centre = np.round(self.start + across, 3)
        # Of half a turn no radius says the centre to more than a tenth of a millimetre.
        turn = DRAWN.choice([DRAWN.uniform(0.3, 2.6), DRAWN.uniform(3.7, 6.0)])
        self.turn = DRAWN.choice([-1, 1]) * turn
        climb = DRAWN.choice([0.0, 1.0]) * DRAWN.uniform(-8, 8)
        self.places = judged(self.start, self.centre, plane, self.turn, climb)
        self.end = self.places[-1]


def polyline(moves):
    """Where each move begins, and the end of the last (n + 1, 3)."""
    begins = np.column_stack([moves["from_x"], moves["from_y"], moves["z_from"]])
    last = [moves["to_x"][-1], moves["to_y"][-1], moves["z_to"][-1]]
    return np.vstack([begins, last])


def apart(places, corners):
    """Greatest distance of places (n, 3) from a line through corners."""
    begin, way = corners[:-1], np.diff(corners, axis=0)
    share = np.einsum("nkj,kj->nk", places[:, None] - begin, way) / np.sum(way**2, axis=1)
    nearest = begin + np.clip(share, 0, 1)[:, :, None] * way
    return np.linalg.norm(places[:, None] - nearest, axis=2).min(axis=1).max()


@pytest.mark.parametrize("plane", ["G18", "G19"])
@pytest.mark.parametrize("with_radius", [False, True])
def test_an_arc_runs_where_the_judge_turns_it(plane, with_radius):
    for _ in range(12):
        way = Way(plane)
        x, y, z = way.start
        line = line_of(plane, way.start, way.centre, way, with_radius=with_radius)
        done = run_dry([f"G0 X{x:.3f} Y{y:.3f} Z{z:.3f}", line])
        assert not done.said, line
        moves = done.moves.only(done.moves["line"] == 2)
        corners = polyline(moves)
        slack = 0.05 if with_radius else NEAR  # a radius places a centre less well
        assert apart(way.places, corners) < slack, line
        assert apart(corners, way.places) < slack, line
        # And in this order: each chord's middle comes later on the arc than the last.
        middles = (corners[1:] + corners[:-1]) / 2
        at = [np.linalg.norm(way.places - middle, axis=1).argmin() for middle in middles]
        assert (np.diff(at) > 0).all(), line
        assert (moves["asked"] == 900).all() and not moves.rapid.any()


def test_a_full_circle_returns_and_a_limit_of_z_cuts_it_flat():
    done = run_dry(["G0 Z10", "G18 G2 I5 K0 F900"])
    corners = polyline(done.moves.only(done.moves["line"] == 2))
    ring = judged((0, 0, 10), (5, 0, 10), "G18", -2 * np.pi, 0)
    assert apart(ring, corners) < NEAR and apart(corners, ring) < NEAR
    done = run_dry(["G0 Z10", "B17", "G18 G2 I5 K0 F900", "G0 X1"])
    corners = polyline(done.moves.only(done.moves["line"] == 3))
    assert corners[:, 2].max() == pytest.approx(10, abs=1e-3)
    assert corners[:, 2].min() == pytest.approx(5, abs=0.01)
