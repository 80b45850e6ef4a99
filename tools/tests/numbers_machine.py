"""A machine with numbers at the end of a line."""


class NumbersMachine:
    """A machine with numbers. It may forget what is sent, and it may move."""

    def __init__(self, *, forgets=(), speed=0.0):
        self.numbers = {12: 2978.4, 15: 8113.73, 38: 0.0}
        self.forgets, self.speed = forgets, speed  # [mm/s]
        self.says = ["PCB v1.2 Detected", "Firmware Version 1.28", "Plumb v1.0.0"]
        self.time, self.x = 0.0, 0.0
        self.waiting = []
        self.written = []

    def write(self, characters):
        self.waiting += characters.decode().splitlines()

    def read(self):
        self.time += 0.1
        self.x += 0.1 * self.speed
        said = [f"<Idle,MPos:{self.x:.2f},0.00,0.00,WPos:0.000,0.000,0.000>"]
        for line in self.waiting:
            said += [*self.answer(line), "ok"]
        self.waiting = []
        return "".join(line + "\r\n" for line in said).encode()

    def answer(self, line):
        if line == "$$":
            return [f"${number}={value:.7g} (a number)" for number, value in self.numbers.items()]
        if line == "B05":
            return self.says
        if line == "B30":
            return ["[Telemetry|eeprom:ok|]"]
        self.written.append(line)
        number, value = line.removeprefix("$").split("=")
        if int(number) not in self.forgets:
            self.numbers[int(number)] = float(value)
        return []

    def seconds(self):
        return self.time

    def close(self):
        pass
