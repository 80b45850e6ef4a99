"""The name of a virtual machine's port: a machine that runs keeps it, a killed machine does not."""

import os

import pytest
from plumb.line import port
from plumb.text.errors import InputError
from plumb.vm.pseudo_terminal import PseudoTerminal


@pytest.fixture(autouse=True)
def locks(tmp_path, monkeypatch):
    """Locks in a folder of the test."""
    (tmp_path / "locks").mkdir()
    monkeypatch.setattr(port.tempfile, "gettempdir", lambda: str(tmp_path / "locks"))


@pytest.fixture
def terminal():
    """Makes a port without a machine behind it."""
    return lambda: PseudoTerminal(None)


def test_the_name_of_a_machine_that_runs_is_refused_and_stays(terminal, tmp_path):
    link = tmp_path / "maslow"
    first, second = terminal(), terminal()
    first.link_as(str(link))
    with pytest.raises(InputError, match="maslow: a virtual machine is at it already; end it or"):
        second.link_as(str(link))
    second.close()
    assert os.readlink(link) == first.path
    first.close()
    assert not os.path.lexists(link)


def test_a_link_of_a_killed_machine_is_replaced_even_if_its_number_is_used_again(
    terminal, tmp_path
):
    link = tmp_path / "maslow"
    _, shell = os.openpty()
    for left in ("/dev/pts/987654", os.ttyname(shell), str(tmp_path / "nothing")):
        link.unlink(missing_ok=True)
        link.symlink_to(left)
        ours = terminal()
        ours.link_as(str(link))
        assert os.readlink(link) == ours.path
        ours.close()


def test_a_link_that_is_not_a_machines_is_kept(terminal, tmp_path):
    (tmp_path / "job.nc").write_text("G21\n")
    link = tmp_path / "maslow"
    link.symlink_to(tmp_path / "job.nc")
    for name in (link, tmp_path / "job.nc"):
        with pytest.raises(InputError, match="give another --link"):
            terminal().link_as(str(name))
    assert (tmp_path / "job.nc").read_text() == "G21\n" and link.is_symlink()


def test_a_link_that_something_else_replaced_is_kept(terminal, tmp_path):
    link = tmp_path / "maslow"
    ours = terminal()
    ours.link_as(str(link))
    link.unlink()
    link.symlink_to("/dev/ttyACM0")
    ours.close()
    assert link.is_symlink()
