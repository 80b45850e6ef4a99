"""A machine at the end of a line that answers and reports; its clock goes on as it is read."""

REPORT = "<Idle,MPos:1.00,-2.50,0.00,WPos:0.000,0.000,0.000>\r\n[PE:0.00,0.00,127]\r\n"


class Board:
    """A machine that answers a line each time it is heard, and reports meanwhile.

    deaf: it never speaks. left_by_grbl: a sender of Grbl was here, so it reports from B05 on.
    """

    def __init__(self, answers=lambda line: "ok", *, deaf=False, left_by_grbl=False):
        self.answers, self.deaf, self.reports = answers, deaf, not left_by_grbl
        self.waiting: list[str] = []
        self.most = 0
        self.time = 0.0
        self.written = b""
        self.holds = False

    def write(self, characters: bytes) -> None:
        self.written += characters
        if self.holds and characters == b"~\n":
            self.holds = False  # it has no `ok`
            return
        self.holds = self.holds or characters == b"\x84"
        if characters.endswith(b"\n"):
            self.waiting.append(characters.decode().rstrip("\n"))
        self.most = max(self.most, sum(len(line) + 1 for line in self.waiting))

    def read(self) -> bytes:
        self.time += 0.2
        if self.deaf:
            return b""
        said = ""
        if self.waiting:
            line = self.waiting.pop(0)
            self.reports = self.reports or line == "B05"
            said = self.answers(line) + "\r\n"
        return (said + REPORT * self.reports).encode()

    def seconds(self) -> float:
        return self.time

    def close(self) -> None:
        pass
