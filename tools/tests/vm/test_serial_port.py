"""The virtual machine behind a serial port, or a socket as on Windows, driven like a board."""

import json
import os
import re
import shlex
import subprocess
import sys
import time
from pathlib import Path

import pytest
import serial
from plumb.cli.main import main
from plumb.cli.vm import EEPROM_BYTES, TRAVELS
from plumb.diary.file import append, read_diary
from served_machine import INTERRUPTIBLE, PLUMB, SPEED, START, plumb


def test_a_program_is_cut_and_the_machine_tells_its_place(served, tmp_path):
    grid = ["grid", "--places=-669,60 669,60 669,-60 -669,-60"]
    plumb(*grid, "--marks", "form.toml", "--output", "grid.nc", folder=tmp_path)
    server = served("--hide", "chain_sag", "--reveal", "--speed", "200")
    sent = plumb("send", "--port", "maslow", "grid.nc", folder=tmp_path)
    assert "and the machine took each" in sent
    printed = plumb("read", "--port", "maslow", "-o", "machine.toml", folder=tmp_path)
    assert "The sled is at x " in printed and "$160" in printed and "$210" not in printed
    assert "Hidden was: chain_sag" in server.stop()
    assert not os.path.lexists(tmp_path / "maslow")


def test_numbers_are_written_read_back_kept_and_brought_back(served, tmp_path):
    served()
    plumb("read", "--port", "maslow", "-o", "machine.toml", folder=tmp_path)
    text = (tmp_path / "machine.toml").read_text()
    (tmp_path / "machine.toml").write_text(text.replace("2978.4", "2980.5"))
    said = plumb("send", "--port", "maslow", "machine.toml", folder=tmp_path)
    assert "$2: 2978.4 -> 2980.5" in said and max(map(len, said.splitlines())) <= 80
    assert "To bring them back:\n  plumb send --undo machine.toml --port maslow\n" in said
    assert len(list(tmp_path.glob("machine-before-*.nc"))) == 1
    said = plumb("send", "--undo", "--port", "maslow", "machine.toml", folder=tmp_path)
    assert "$2: 2980.5 -> 2978.4" in said
    there, back = read_diary(tmp_path).of_kind("numbers")
    assert there.content["changed"] == {"$2": [2978.4, 2980.5]}
    assert back.content["changed"] == {"$2": [2980.5, 2978.4]}
    assert there.content["firmware"] == "Firmware Version 1.28"
    assert (tmp_path / there.content["kept"]).is_file()
    # From now on the folder's diary hears of each line.
    plumb("send", "--port", "maslow", "B10 L", folder=tmp_path)
    (entry,) = read_diary(tmp_path).of_kind("program")
    assert entry.content["program"] == "B10 L" and entry.content["whole"]


MOVES = "G21\nG90\nG1 X0 Y60 F800\nG4 P500\n"


def place(said: str) -> tuple[float, ...]:
    """The place of sled and bit by `plumb read` [mm]; empty if it is unknown."""
    found = re.search(r"The sled is at x (\S+), y (\S+), the bit at z (\S+) mm", said)
    return tuple(map(float, found.groups())) if found else ()


@pytest.mark.parametrize("end", ["M2", "G0 X--5"], ids=["good", "refused"])
def test_a_program_ends_when_the_place_is_kept(end, served, tmp_path):
    served()
    (tmp_path / "job.nc").write_text(f"{MOVES}{end}\n")
    code = 0 if end == "M2" else 2
    for _ in range(2):
        said = plumb("send", "--port", "maslow", "job.nc", folder=tmp_path, code=code)
        assert "Position Lost" not in said
    assert "Position Lost" not in plumb("read", "--port", "maslow", folder=tmp_path)


def test_the_printed_command_brings_a_lost_place_back(served, tmp_path):
    """Each command resets the board, which keeps no place as long as z is not known."""
    served()
    plumb("read", "--port", "maslow", "-o", "machine.toml", folder=tmp_path)
    with serial.Serial(str(tmp_path / "maslow"), 57600, timeout=START) as line:
        line.read_until(b"Detected")
        line.write(b"B05\nG1 X900 F100\n")
        line.read_until(b",MPos:5.")
    lost = plumb("read", "--port", "maslow", folder=tmp_path)
    assert "does not know where its sled is" in lost and "B06 or B08" in lost
    assert "plumb send 'B06 ...' 'G10 Z0'" in " ".join(lost.split())
    plumb("recover", "machine.toml", "--keep=left=-900,250", "-o", "left.nc", folder=tmp_path)
    said = plumb("recover", "machine.toml", "--at", "left", folder=tmp_path)
    z_known, all_lost = re.findall(r"^  plumb (send .*)$", said, re.MULTILINE)
    assert all_lost == f"{z_known} 'G10 Z0'"
    for command, back in ((z_known, False), (all_lost, True)):
        plumb(*shlex.split(command), "--port", "maslow", folder=tmp_path)
        now = plumb("read", "--port", "maslow", folder=tmp_path)
        assert (place(now)[:2] == pytest.approx((-900, 250), abs=0.05)) == back


@pytest.mark.parametrize("words", [("B05", "job.nc"), ("job.nc", "B05"), ("machine.toml", "B05")])
def test_a_file_is_sent_alone(words, here, capsys):
    (here / "job.nc").write_text("G0 X1\n")
    assert main(["send", *words, "--port", "nowhere"]) == 2
    assert "goes alone" in capsys.readouterr().err


def test_the_printed_command_resumes_a_stopped_job(served, tmp_path):
    served()
    # G1 is open while the dwell lasts. A sender that a busy computer holds up may take it for open
    # longer, or hear the dwell's end as well; the file goes on from the line that it says.
    moves = MOVES.replace("P500", "P1300")
    (tmp_path / "job.nc").write_text(f"(a job)\n{moves}G0 X--5\n")
    append(tmp_path, "fit", {})
    said = plumb("send", "--port", "maslow", "job.nc", folder=tmp_path, code=2)
    assert "'G0 X--5': the machine says: ALARM: Halted" in said
    (entry,) = read_diary(tmp_path).of_kind("program")
    assert entry.content["lines"] == 5 and not entry.content["whole"]
    commands = re.findall(r"^  plumb (.*)$", said.replace("\\\n", " "), re.MULTILINE)
    read, resume = (shlex.split(each) for each in commands)
    assert read == ["read", "--port", "maslow", "-o", "machine.toml"]
    assert resume[-2:] == ["-o", "rest.nc"]
    line = int(resume[resume.index("--line") + 1])
    assert f"All before line {line} of job.nc is done" in said or "Nothing of job.nc" in said
    plumb(*read, folder=tmp_path)
    plumb(*resume, folder=tmp_path)
    assert ("G1 X0 Y60 F800" in (tmp_path / "rest.nc").read_text()) == (line <= 4)


def test_json_states_where_a_job_stopped(served, tmp_path):
    served()
    plumb("send", "--port", "maslow", "$75=0.95", folder=tmp_path)
    (tmp_path / "job.nc").write_text(WAITING)
    words = ("send", "--json", "--port", "maslow", "job.nc")
    said = plumb(*words, folder=tmp_path, code=1, typed="s\n")
    answer, end = json.JSONDecoder().raw_decode(said)
    assert answer["lines"] == 6 and answer["stopped_at"] <= 4
    assert "5 V fell" in answer["warnings"][0]
    assert "The machine has stopped." in said[end:]
    said = plumb("send", "--json", "--port", "maslow", "B10 L", folder=tmp_path)
    answer, _ = json.JSONDecoder().raw_decode(said)
    assert answer["stopped_at"] is None and any("[Measure" in line for line in answer["said"])


def test_ctrl_c_stops_the_machine_and_it_knows_where_it_is(served, tmp_path):
    served()
    (tmp_path / "job.nc").write_text("G21\nG1 X5 F300\nG4 P200\nB10 L\nG1 X900\n")
    command = [PLUMB[0], "-u", *PLUMB[1:], "send", "--port", "maslow", "job.nc"]
    sending = INTERRUPTIBLE(
        command, cwd=tmp_path, stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True
    )
    assert any("[Measure" in line for line in sending.stdout)  # so it is on its way to x 900
    sending.send_signal(2)
    said = sending.communicate(timeout=START)[0]
    assert "The machine has stopped." in said and "plumb resume job.nc machine.toml --line" in said
    assert sending.returncode == 1
    said = plumb("read", "--port", "maslow", folder=tmp_path)
    assert "ALARM" not in said
    assert 1 < place(said)[0] < 899


WAITING = """G21
G0 X5
(let 5 kg more hang on the sled)
M0
G0 X10
M0
B10 L
"""


def test_a_program_that_waits_says_why_and_goes_on_with_enter(served, tmp_path):
    served()
    (tmp_path / "job.nc").write_text(WAITING)
    said = plumb("send", "--port", "maslow", "job.nc", folder=tmp_path, typed="\n\n")
    enter = "Enter goes on; s and Enter stops: "
    assert f"The program waits: let 5 kg more hang on the sled. {enter}" in said
    assert f"The program waits: it does not say why. {enter}" in said
    assert said.index("[Measure") > said.rindex(enter)
    assert "6 lines were sent" in said


@pytest.mark.parametrize("typed", ["s\n", ""])
def test_a_program_that_waits_is_stopped_by_s_and_where_nobody_can_answer(served, tmp_path, typed):
    served()
    (tmp_path / "job.nc").write_text(WAITING)
    said = plumb("send", "--port", "maslow", "job.nc", folder=tmp_path, typed=typed, code=1)
    assert "The machine has stopped." in said and "[Measure" not in said
    assert re.search(r"x (4\.9|5\.0)\d,", plumb("read", "--port", "maslow", folder=tmp_path))


def test_z_is_moved_and_set_in_a_pause_and_the_depth_holds_from_there(served, tmp_path):
    served()
    (tmp_path / "job.nc").write_text("G21\nG0 Z5\nM0\nG1 Z-2 F300\nG0 Z5\nM30\n")
    typed = "G91 G0 Z-3 G90\nG0 X5\nG10 Z\u00bd\nG10 Z0\n\n"
    said = plumb("send", "--port", "maslow", "job.nc", folder=tmp_path, typed=typed)
    assert "error: the program waits" in said and "is not plain text" in said
    # What the machine answers stands before the next question.
    assert said[: said.index("error:")].count("The machine waits.") == 1
    assert "Z goes back to 5.00" in said and "6 lines were sent" in said
    read = plumb("read", "--port", "maslow", folder=tmp_path)
    assert place(read)[::2] == pytest.approx((0, 5), abs=0.05)


def test_a_program_of_which_nothing_is_done_begins_again(served, tmp_path):
    served("--fresh")
    plumb("send", "--port", "maslow", "$75=0.95", folder=tmp_path)
    (tmp_path / "job.nc").write_text("G21\nG0 X5\nG0 X10\n")
    said = plumb("send", "--port", "maslow", "job.nc", folder=tmp_path, code=2)
    assert "Nothing of job.nc is surely done.\n" in said and "All before" not in said
    assert "To begin again:" in said and "--line 1 " in said and "5 V fell" in said


def test_ctrl_c_ends_the_machine_from_the_moment_that_its_port_is_there(tmp_path, monkeypatch):
    link, memory = tmp_path / "maslow", tmp_path / "memory.bin"

    def interrupted(*said, **options):
        assert link.is_symlink()
        raise KeyboardInterrupt

    monkeypatch.setattr("plumb.cli.vm.print", interrupted, raising=False)
    assert main(["vm", "--link", str(link), "--eeprom", str(memory)]) == 0
    assert not link.is_symlink() and memory.exists()


def test_the_sled_hangs_at_the_next_start_where_it_hung_at_the_end(served, tmp_path):
    def hangs() -> tuple[float, ...]:
        return TRAVELS.unpack((tmp_path / "memory.bin").read_bytes()[EEPROM_BYTES:])

    first = served("--eeprom", "memory.bin")
    plumb("send", "--port", "maslow", "G1 X-700 Y-200 Z4 F900", folder=tmp_path)
    first.stop()
    before = hangs()
    second = served("--eeprom", "memory.bin")
    said = plumb("read", "--port", "maslow", folder=tmp_path)
    assert place(said) == pytest.approx((-700, -200, 4), abs=0.05)
    second.stop()
    assert hangs() == pytest.approx(before, abs=0.05) and hangs()[2] == pytest.approx(4, abs=0.05)
    third = served("--eeprom", "memory.bin")  # killed in the middle of a move
    words = ["send", "--port", "maslow", "G1 X0 Y0 F100"]  # some seconds
    sending = subprocess.Popen([*PLUMB, *words], cwd=tmp_path, stderr=subprocess.DEVNULL)
    end = time.monotonic() + START
    while abs(hangs()[0] - before[0]) < 20 and time.monotonic() < end:
        time.sleep(0.1)
    third.program.kill()
    sending.wait()
    assert 20 <= abs(hangs()[0] - before[0]) < abs(1600 - before[0])
    (tmp_path / "memory.bin").write_bytes(b"\xff" * EEPROM_BYTES)  # as older files are
    served("--eeprom", "memory.bin").stop()
    assert hangs() == pytest.approx((1651, 1651, 0), abs=0.05)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["vm", "--hide", "wind"], "--hide unknown name 'wind'"),
        (["vm", "--mega", "absent.elf"], "cannot read absent.elf"),
        (["vm", "--link", "here"], "here: is the name of something else; give another --link"),
        (["vm", "--link", "absent/maslow"], "cannot be the name of the port"),
        (["vm", "--eeprom", "here"], "is not a memory file of 4096 bytes"),
        (["read", "--port", "absent"], "absent: cannot be opened"),
        (["flash", "here"], "here: is not a HEX file with a program"),
    ],
)
def test_impossible_values_are_refused_in_one_line(tmp_path, words, why):
    (tmp_path / "here").write_text("something\n")
    said = plumb(*words, folder=tmp_path, code=2)
    assert why in said
    assert said.count("\n") == 1
    assert (tmp_path / "here").read_text() == "something\n"


@pytest.fixture
def name(tmp_path):
    """The name of a machine's port; the machine ends with the test."""
    command = [*PLUMB, "vm", "--link", "socket://localhost:0", "--speed", str(SPEED)]
    machine = INTERRUPTIBLE(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    yield re.match(r"The machine is at (socket://localhost:\d+)\.", machine.stdout.readline())[1]
    machine.terminate()
    machine.wait()


def test_a_program_is_sent_through_a_socket_and_each_opening_resets_the_board(name, tmp_path):
    plumb("grid", "--places=0,100 300,100", "--output", "grid.nc", folder=tmp_path)
    assert "the machine took each" in plumb("send", "--port", name, "grid.nc", folder=tmp_path)
    assert "The sled is at x " in plumb("read", "--port", name, folder=tmp_path)
    for _ in range(2):
        with serial.serial_for_url(name, timeout=START) as line:
            assert line.read_until(b"Detected").endswith(b"Detected")


def test_a_socket_that_is_taken_or_is_no_name_is_refused(name, tmp_path):
    said = plumb("vm", "--link", name, folder=tmp_path, code=2)
    assert f"{name}: a virtual machine is at it already; end it or give another number" in said
    said = plumb("vm", "--link", "socket://garage:7000", folder=tmp_path, code=2)
    assert "is not like socket://localhost:7000" in said


# As GroundControl opens a port: twice, then it drops DTR and raises it again.
DROPS_DTR = """
port = serial.Serial("maslow", 57600, timeout=30)
port.close()
port.open()
greet()
port.dtr = False
port.dtr = True
greet()
port.rts = False
port.rts = True
port.write(b"B05\\n")
port.read_until(b"Firmware Version 1.28")
assert b"PCB" not in port.read_until(b"ok")
"""
# As WebControl does: with odd parity in between.
ASKS_PARITY = """
port = serial.Serial("maslow", 57600, timeout=30)
port.parity = serial.PARITY_ODD
port.close()
port.open()
port.close()
port.parity = serial.PARITY_NONE
port.open()
greet()
"""
GREET = """
import serial
def greet():
    assert port.read_until(b"ok\\r\\n").count(b"PCB v1.2") == 1
"""


def client(program: str, folder: Path, **environment: str) -> subprocess.CompletedProcess:
    """A program that does this at the port."""
    return subprocess.run(
        [sys.executable, "-c", GREET + program],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=2 * START,
    )


@pytest.mark.parametrize(
    ("program", "why"), [(DROPS_DTR, "Inappropriate ioctl"), (ASKS_PARITY, "Invalid argument")]
)
def test_a_client_opens_the_port_as_it_opens_a_boards(served, tmp_path, program, why):
    served()
    assert why in client(program, tmp_path).stderr
    done = client(program, tmp_path, LD_PRELOAD=library(tmp_path))
    assert done.returncode == 0, done.stderr


def test_other_files_answer_as_without_it(tmp_path):
    program = """
import fcntl, os, struct, termios
lines = struct.pack("I", termios.TIOCM_DTR)
for file in (os.open("plain", os.O_RDWR | os.O_CREAT), os.pipe()[1]):
    try:
        fcntl.ioctl(file, termios.TIOCMBIC, lines)
        raise SystemExit("no error")
    except OSError as error:
        assert error.errno == 25, error
"""
    done = client(program, tmp_path, LD_PRELOAD=library(tmp_path))
    assert done.returncode == 0, done.stderr


def library(folder: Path) -> str:
    """Where the library is, as the command says."""
    return plumb("vm", "--preload", folder=folder).strip()
