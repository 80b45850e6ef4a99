"""The curves of a move: the sled follows what is asked, and the encoders what the chains do."""

import numpy as np
from curves import MOVES, curves, drawn


def test_a_move_is_seen_from_the_set_point_to_the_bit():
    seen = curves()
    assert MOVES[-1].startswith("G2 X20 Y40")
    assert np.allclose(seen.sled[-1], (20, 40), atol=0.05)
    assert len(seen.reports) > 60 and np.abs(seen.reports[:, 3:]).max() < 0.5
    # A longer left chain lets the sled go to the right.
    assert seen.chains[np.argmax(seen.sled[:, 0]), 0] > 40
    lifting = seen.seconds < 4
    assert seen.duties[lifting, 1].mean() > 150 > -50 > seen.duties[lifting, 0].mean()
    assert not seen.duties[-1].any()
    at = np.searchsorted(seen.seconds, seen.reports[:, 0])
    assert np.abs(seen.sled[at] - seen.reports[:, 1:3]).max() < 1.0
    assert drawn(seen).startswith(b"\x89PNG")
