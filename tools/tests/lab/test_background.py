"""Work in the background: how far it is, and when there is an answer."""

from threading import Event

from plumb.lab.background import Background


def test_work_whose_steps_are_over_is_not_done_before_its_result_is_there():
    steps_over, released = Event(), Event()

    def work(progress):
        progress(1.0)
        steps_over.set()
        released.wait(60)
        return "result"

    background = Background()
    assert background.ask("kind", "state", work).result is None
    assert steps_over.wait(60)
    early = background.ask("kind", "state", work)
    released.set()
    assert early.result is None
    assert early.share < 1
    while (late := background.ask("kind", "state", work)).share < 1:
        pass
    assert late.result == "result"
