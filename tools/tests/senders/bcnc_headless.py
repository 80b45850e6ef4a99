"""bCNC without its window: reads calls as lines of JSON, and prints an answer to each.

What is stubbed is Tk. What its window does for the machine is here in our words: it queues a
program's lines, watches for Hold, and ends a run when each line is answered.
"""

import builtins
import importlib.abc
import importlib.machinery
import json
import sys
import threading
import time
import types

LOOK_EVERY = 0.1  # [s] as its window looks
WINDOW = ("tkinter", "PIL", "cv2")


class Nothing:
    """A widget without a window."""

    def __init__(self, *what, **how):
        pass

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return Nothing()

    def __call__(self, *what, **how):
        return Nothing()


class NoWindow(types.ModuleType):
    """A module of Tk: any class that is asked for, and names for its constants."""

    __path__ = ()

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        if name.endswith("Version"):
            return 8.6
        return name if name.isupper() else type(name, (Nothing,), {})


class NoWindowFinder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds the modules of windows, here or not, as empty modules."""

    def find_spec(self, name, path, target=None):
        """Take over what belongs to a window."""
        if name.partition(".")[0] in WINDOW:
            return importlib.machinery.ModuleSpec(name, self, is_package=True)
        return None

    def create_module(self, spec):
        """Return an empty module."""
        return NoWindow(spec.name)

    def exec_module(self, module):
        """Do nothing: its names come when they are asked for."""


def bcnc_sender(folder):
    """Return bCNC's class Sender and its state, imported as its start does."""
    sys.meta_path.insert(0, NoWindowFinder())
    for part in ("controllers", "plugins", "lib", ""):
        sys.path.insert(1, f"{folder}/{part}".rstrip("/"))
    builtins._ = str
    import CNC
    import Sender
    import Utils

    Utils.loadConfiguration(True)
    return Sender.Sender, CNC.CNC, CNC.WAIT


def nothing(*what, **how):
    """Do nothing: there is no window."""


class Window:
    """The tasks of bCNC's window for its sender, one at a time."""

    def __init__(self, sender, cnc, wait):
        self.sender, self.cnc, self.wait = sender, cnc, wait
        self.heard = []
        self.purges = 0  # of the machine's lines, each with a reset
        self.turn = threading.Lock()
        for name in ("disable", "busy", "notBusy", "event_generate"):
            setattr(sender, name, nothing)
        self._purge = sender.purgeController
        sender.purgeController = self.purge
        threading.Thread(target=self.watch, daemon=True).start()

    def purge(self):
        """Count what the button Stop and the end of a run do."""
        self._purge()
        self.purges += 1

    def watch(self):
        """Look at the machine ten times a second."""
        while True:
            time.sleep(LOOK_EVERY)
            with self.turn:
                self.look()

    def look(self):
        """Take the log, and see whether the machine holds or a run is over."""
        sender = self.sender
        while sender.log.qsize():
            kind, text = sender.log.get_nowait()
            self.heard.append(f"{kind} {text}".strip())
        if sender._posUpdate:
            sender._pause = "Hold" in self.cnc.vars["state"]
            sender._posUpdate = False
        if sender.running and sender._gcount >= sender._runLines:
            sender.runEnded()

    def run_lines(self, lines):
        """The button Start."""
        sender = self.sender
        sender.cleanAfter = True
        sender.initRun()
        sender._runLines = sys.maxsize
        sender._gcount = 0
        self.cnc.vars["running"] = True
        self.cnc.vars["_OvChanged"] = True
        queued = self.cnc.compile(lines)
        for line in queued:
            sender.queue.put(f"{line}\n" if isinstance(line, str) else line)
        sender._runLines = len(queued) + 1
        sender.queue.put((self.wait,))

    def change(self, what, percent):
        """The override slider of feed, rapids or spindle."""
        self.cnc.vars[f"_Ov{what}"] = percent
        self.cnc.vars["_OvChanged"] = True

    def do(self, name, *what):
        """A button of the window, or a function of the sender."""
        with self.turn:
            getattr(self if hasattr(self, name) else self.sender, name)(*what)

    def state(self):
        """Return what bCNC knows of the machine."""
        names = "state version mx my mz wx wy wz curfeed OvFeed OvRapid OvSpindle G"
        thread = self.sender.thread
        return {
            "vars": {name: self.cnc.vars.get(name) for name in names.split()},
            "running": self.sender.running,
            "alive": bool(thread and thread.is_alive()),
            "purges": self.purges,
            "heard": self.heard,
        }


def main(folder):
    """Take calls until there are none."""
    answers, sys.stdout = sys.stdout, sys.stderr
    sender_class, cnc, wait = bcnc_sender(folder)
    window = Window(sender_class(), cnc, wait)
    for line in sys.stdin:
        name, *what = json.loads(line)
        if name != "state":
            window.do(name, *what)
        print(json.dumps(window.state()), file=answers, flush=True)
    window.sender.thread = None


if __name__ == "__main__":
    main(sys.argv[1])
