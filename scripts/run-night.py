#!/usr/bin/env python3
"""Bakes a scene for a night, interrupts the bake in five ways, and shows that it ends with the very bits of an undisturbed one.

  scripts/run-night.py [SCENE] [--night 2h] [--lucarne PROGRAM] [--work FOLDER] [--out docs/data] [-- OPTIONS OF THE BAKE]

NIGHT=2h in the environment is the same as --night 2h; the undisturbed bake of the same photons comes after it and takes as long
again, or runs beside the last stretch of the night, whose photons are then settled when it begins (--beside). The interruptions, at equal distances:

  kill         kill -9 while photons are traced
  kill-saving  kill -9 while a state is being written
  term         SIGTERM: ends with 130 and leaves a state
  disk-full    no room for the next state: ends with 5, or goes on with a warning and is then ended by SIGTERM
  vanished     kill -9, then the newest state is removed: goes on from the one before; and before that, for a while, the
               folder cannot be written

After each, `bake --resume` goes on. Disk-full and the folder that cannot be written need a file system of their own: as root the
script mounts a small tmpfs. Otherwise the bake gets a limit on the size of files in place of the one, and permissions are
taken in place of the other.

Writes night.log (what happened, line by line), night.json (each interruption with the photons before and after it, and the
comparison) and the report of the bake, night-report.json and night-report.html. Ends with 0 only if all resumed and the hashes agree.
"""
import argparse
import json
import math
import os
import platform
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
UNITS = {"s": 1, "m": 60, "h": 3600, "d": 86400}
INTERRUPTED, OUT_OF_RESOURCE = 130, 5


def seconds_of(text):
    """Seconds of "8h", "1h30m", "90s"."""
    parts = re.findall(r"([0-9.]+)([smhd])", text)
    if not parts or "".join(a + b for a, b in parts) != text:
        raise SystemExit(f"run-night: a time is like 2h, 1h30m or 90s, not '{text}'")
    return sum(float(a) * UNITS[b] for a, b in parts)


class Log:
    """Lines with the time since the start, on the terminal and in a file."""

    def __init__(self, path):
        self.file = open(path, "w", encoding="utf-8")
        self.start = time.monotonic()

    def __call__(self, text):
        line = f"{time.monotonic() - self.start:10.1f} s  {text}"
        print(line, flush=True)
        self.file.write(line + "\n")
        self.file.flush()


class Workplace:
    """A folder for the bake; on a tmpfs of its own where we may mount one, so that it can be filled and made read-only."""

    def __init__(self, folder, room_bytes):
        self.own = folder is None
        self.folder = folder or tempfile.mkdtemp(prefix="lucarne-night-")
        os.makedirs(self.folder, exist_ok=True)
        mount = ["mount", "-t", "tmpfs", "-o", f"size={room_bytes}", "tmpfs", self.folder]
        self.mounted = os.geteuid() == 0 and subprocess.run(mount, capture_output=True).returncode == 0
        self.filler = os.path.join(self.folder, "filler")

    def fill(self):
        """Leaves no room, also none of what was freed since. Only on a disk of our own."""
        with open(self.filler, "ab") as f:
            block = bytes(1 << 20)
            try:
                while True:
                    f.write(block)
                    f.flush()
            except OSError:
                pass

    def make_room(self):
        if os.path.exists(self.filler):
            os.remove(self.filler)

    def close_to_writing(self, states):
        """True where the states cannot be written from now on."""
        if self.mounted:
            # Open files keep a file system writable as a whole; the folder is covered by a read-only view of itself.
            if subprocess.run(["mount", "--bind", states, states], capture_output=True).returncode != 0:
                return False
            return subprocess.run(["mount", "-o", "remount,ro,bind", states], capture_output=True).returncode == 0
        if os.geteuid() == 0:
            return False  # permissions do not hold root back
        os.chmod(states, 0o555)
        return True

    def open_to_writing(self, states):
        if self.mounted:
            subprocess.run(["umount", states], capture_output=True)
        else:
            os.chmod(states, 0o755)

    def close(self):
        if self.mounted:
            subprocess.run(["umount", "-l", self.folder], capture_output=True)
        if self.own:
            shutil.rmtree(self.folder, ignore_errors=True)


class Night:
    def __init__(self, arguments, log, place):
        self.a, self.log, self.place = arguments, log, place
        self.output = os.path.join(place.folder, "night.dlm")
        self.states = os.path.join(place.folder, "night.checkpoint")
        self.messages = tempfile.NamedTemporaryFile(prefix="lucarne-night-", suffix=".log").name  # not on a disk that fills
        self.process, self.events, self.failed = None, [], False
        self.other, self.reference = None, None  # the undisturbed bake
        self.runs = 0

    # The bake, as a process.

    def command(self, output, photons, extra):
        scene = [self.a.scene] if self.a.scene else []
        return [self.a.lucarne, "bake", *scene, "-o", output, "--photons", str(photons), *extra, *self.a.bake]

    def start(self, photons, extra=(), file_limit=None):
        def limit():
            if file_limit is not None:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # writes fail instead
                resource.setrlimit(resource.RLIMIT_FSIZE, (file_limit, file_limit))

        self.runs += 1
        extra = ("--checkpoint", f"{self.a.checkpoint:g}s", "--resume", *extra)
        with open(self.messages, "wb") as f:
            self.process = subprocess.Popen(self.command(self.output, photons, extra), stdout=f, stderr=f, preexec_fn=limit)
        self.log_command(f"run {self.runs}", self.process)

    def log_command(self, what, process):
        shown = ["lucarne", *(os.path.basename(x) if os.path.isabs(x) else x for x in process.args[1:])]
        self.log(f"{what}: {' '.join(shown)}")

    def running(self):
        return self.process.poll() is None

    def said(self):
        with open(self.messages, encoding="utf-8", errors="replace") as f:
            return f.read()

    def end(self, number):
        """Sends a signal, waits, and returns the exit code as a shell gives it."""
        if self.running():
            self.process.send_signal(number)
        code = self.process.wait()
        return code if code >= 0 else 128 - code

    # What is on disk.

    def list(self):
        try:
            return sorted(n for n in os.listdir(self.states) if n.startswith("state-") and n.endswith(".part"))
        except OSError:
            return []

    def being_written(self):
        """Bytes of a state that is being written; none: −1."""
        try:
            with os.scandir(self.states) as entries:
                return max((e.stat().st_size for e in entries if e.name.startswith(".") and ".part" in e.name), default=-1)
        except OSError:
            return -1

    def saved_photons(self):
        """Of the newest state that is whole; the program judges."""
        for name in reversed(self.list()):
            o = subprocess.run([self.a.lucarne, "info", os.path.join(self.states, name), "--json"], capture_output=True)
            if o.returncode == 0:
                return json.loads(o.stdout)["photons"]
        return 0

    # Waiting. A bake that ends by itself while an interruption is waited for is a night that was too short.

    def wait(self, until, least_states=0, most=None):
        begun = time.monotonic()
        known = set(self.list())
        while self.running():
            now = time.monotonic()
            new = len(set(self.list()) - known)
            if now >= until and new >= least_states:
                return True
            if most is not None and now - begun > most:
                return True
            time.sleep(0.02)
        return False

    def note(self, kind, code, **more):
        event = {"kind": kind, "seconds": round(time.monotonic() - self.log.start, 1), "exit_code": code,
                 "saved_photons": self.saved_photons(), **more}
        self.events.append(event)
        self.log(f"{kind}: exit code {code}, {event['saved_photons']} photons are saved"
                 + "".join(f", {k.replace('_', ' ')}: {v}" for k, v in more.items()))

    def fail(self, why):
        self.failed = True
        self.log(f"FAILED: {why}\n{self.said()}")

    def expect_resumed(self, photons):
        """After an interruption the next run must say that it goes on from the photons that were saved."""
        said = self.said()
        match = re.search(r"going on from ([0-9.]+[kMGT]?) photons", said)
        if photons > 0 and not match:
            self.fail("the run did not go on from the state")
        elif match:
            self.log(f"went on from {match.group(1)} photons")

    # The five ways.

    def kill(self):
        return self.end(signal.SIGKILL), {}

    def kill_saving(self):
        """Stops the bake when a state is seen half written, makes sure that it still is, and kills it then."""
        patience = time.monotonic() + max(60, 20 * self.a.checkpoint)
        half = -1
        while self.running() and half <= 0 and time.monotonic() < patience:
            if self.being_written() < 0:
                time.sleep(0.0005)
                continue
            self.process.send_signal(signal.SIGSTOP)
            time.sleep(0.05)
            half = self.being_written()
            if half <= 0:
                self.process.send_signal(signal.SIGCONT)
        if half <= 0:
            self.log("no state was caught while it was written")
        return self.end(signal.SIGKILL), {"half_written_bytes": half}

    def term(self):
        code = self.end(signal.SIGTERM)
        if code != INTERRUPTED:
            self.fail(f"SIGTERM ended the bake with {code}, not {INTERRUPTED}")
        return code, {}

    def disk_full(self):
        if self.place.mounted:
            self.place.fill()
            how = "tmpfs filled"
        else:
            how = "limit on the size of files"  # set when this run was started
        # It ends by itself, or says that it goes on without a state.
        until = time.monotonic() + max(120, 30 * self.a.checkpoint)
        while self.running() and "no state saved" not in self.said() and time.monotonic() < until:
            if self.place.mounted:
                self.place.fill()  # an older state that was removed for the next makes room; others take it
            time.sleep(0.01)
        ended = not self.running()
        warned = "no state saved" in self.said()
        if self.place.mounted:
            self.place.make_room()
        code = self.end(signal.SIGTERM)
        if ended and code != OUT_OF_RESOURCE:
            self.fail(f"a full disk ended the bake with {code}, not {OUT_OF_RESOURCE}")
        if not ended and not warned:
            self.fail("the bake did not notice the full disk")
        return code, {"how": how, "ended_by_itself": ended, "warned": warned}

    def vanished(self):
        held = self.place.close_to_writing(self.states)
        if held:
            until = time.monotonic() + max(60, 10 * self.a.checkpoint)
            while self.running() and "no state saved" not in self.said() and time.monotonic() < until:
                time.sleep(0.05)
        noticed = not held or "no state saved" in self.said() or not self.running()
        if not noticed:
            self.fail("the bake did not notice that its folder cannot be written")
        code = self.end(signal.SIGKILL)
        if held:
            self.place.open_to_writing(self.states)
        names = self.list()
        if names:
            os.remove(os.path.join(self.states, names[-1]))
        return code, {"read_only_for_a_while": held, "states_before": len(names), "removed": names[-1:] or None}

    WAYS = (("kill", kill), ("kill-saving", kill_saving), ("term", term), ("disk-full", disk_full), ("vanished", vanished))

    # The night.

    def run(self, night, rate):
        photons = 10 ** math.ceil(math.log10(max(1e6, 20 * rate * night)))  # more than there is time for
        begun = time.monotonic()
        for i, (kind, interrupt) in enumerate(self.WAYS):
            before = self.saved_photons()
            limit = None
            if kind == "disk-full" and not self.place.mounted:
                limit = 4096
            self.start(photons, (), limit)
            at = begun + night * (i + 1) / (len(self.WAYS) + 1)
            # States of this run are wanted before it is interrupted, or there is nothing to lose; not on a full disk.
            if not self.wait(at, 0 if limit else 2, most=None):
                self.fail(f"the bake ended before '{kind}': give more photons or a longer night")
                break
            self.expect_resumed(before)
            code, more = interrupt(self)
            self.note(kind, code, **more)
        if not self.events:
            return None
        before = self.saved_photons()
        if self.a.has_time and not self.a.beside:
            return self.finish(photons, ("--time", f"{self.a.share:g}s"), before)
        # As many more as the photons of the night so far lead to expect.
        photons = before + max(100_000, int(before / (time.monotonic() - begun) * self.a.share))
        if self.a.beside:
            self.start_undisturbed(photons)
        return self.finish(photons, (), before)

    def finish(self, photons, extra, before):
        report = os.path.join(self.place.folder, "night-report.json")
        self.start(photons, (*extra, "--report", report))
        code = self.process.wait()
        self.expect_resumed(before)
        if code != 0:
            self.fail(f"the last run ended with {code}")
            return None
        with open(report, encoding="utf-8") as f:
            return json.load(f)

    def start_undisturbed(self, photons):
        self.reference = os.path.join(self.place.folder, "undisturbed.dlm")
        self.other = subprocess.Popen(self.command(self.reference, photons, ("--checkpoint", "0", "--quiet")))
        self.log_command("undisturbed", self.other)

    def undisturbed(self, photons):
        if self.other is None:
            self.start_undisturbed(photons)
        self.other.wait()
        o = subprocess.run([self.a.lucarne, "info", self.reference, "--json"], capture_output=True)
        if o.returncode != 0:
            self.fail("the undisturbed bake has no light maps")
            return None
        return json.loads(o.stdout)["content_hash"]


def arguments():
    p = argparse.ArgumentParser(description=__doc__.split("\n")[0], epilog=__doc__.split("\n\n", 1)[1],
                                formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("scene", nargs="?", help="a .glb or .gltf file; none: the built-in room")
    p.add_argument("--night", default=os.environ.get("NIGHT", "2h"), help="how long to bake (2h)")
    p.add_argument("--checkpoint", type=float, help="seconds between states (a sixtieth of the night, 0.2 to 300)")
    p.add_argument("--beside", action="store_true", help="the undisturbed bake runs beside the last stretch")
    p.add_argument("--lucarne", default=os.path.join(ROOT, "build/release/cli/lucarne"))
    p.add_argument("--work", help="folder for the bake (a new one)")
    p.add_argument("--room", default="4G", help="size of the tmpfs for the bake (4G)")
    p.add_argument("--out", default=os.path.join(ROOT, "docs/data"))
    options = sys.argv[1:]
    bake = []
    if "--" in options:
        at = options.index("--")
        options, bake = options[:at], options[at + 1:]
    a = p.parse_args(options)
    a.bake, a.night_seconds = bake, seconds_of(a.night)
    a.checkpoint = a.checkpoint or min(300, max(0.2, a.night_seconds / 60))
    a.share = a.night_seconds / (len(Night.WAYS) + 1)
    a.has_time = b"--time" in subprocess.run([a.lucarne, "bake", "--help"], capture_output=True, check=True).stdout
    return a


def expected_rate(a):
    """Photons a second, as the check before the bake measures them."""
    scene = [a.scene] if a.scene else []
    layout = [o for o in a.bake]
    o = subprocess.run([a.lucarne, "check", *scene, "--json", *layout], capture_output=True)
    if o.returncode != 0:
        raise SystemExit(o.stderr.decode())
    checked = json.loads(o.stdout)
    if "photons_per_second" not in checked["time"]:
        raise SystemExit("run-night: the scene has no light")
    return checked["time"]["photons_per_second"]


def copy_without_folders(file, to, folders):
    """The report is to be shown elsewhere: of the paths in it the names remain."""
    with open(file, encoding="utf-8") as f:
        text = f.read()
    for folder in folders:
        if folder:
            text = text.replace(os.path.join(folder, ""), "")
    with open(os.path.join(to, os.path.basename(file)), "w", encoding="utf-8") as f:
        f.write(text)


def main():
    a = arguments()
    os.makedirs(a.out, exist_ok=True)
    log = Log(os.path.join(a.out, "night.log"))
    rate = expected_rate(a)
    log(f"a night of {a.night}, a state every {a.checkpoint:g} s, about {rate:.3g} photons a second")
    place = Workplace(a.work, a.room)
    log("on a tmpfs of its own" if place.mounted else "not root, or no mount: limits and permissions stand for a full disk")
    night = Night(a, log, place)
    try:
        report = night.run(a.night_seconds, rate)
        reference = night.undisturbed(report["photons"]) if report else None
        same = report is not None and reference == report["content_hash"]
        if report:
            log(f"disturbed   {report['content_hash']}, {report['photons']} photons, {report['seconds']:.0f} s of tracing")
            log(f"undisturbed {reference}: {'THE SAME' if same else 'NOT THE SAME'}")
            for end in ("json", "html"):
                file = os.path.join(place.folder, "night-report." + end)
                if os.path.exists(file):
                    copy_without_folders(file, a.out, [place.folder, os.path.dirname(a.scene or "")])
        result = {"night_seconds": a.night_seconds, "scene": os.path.basename(a.scene) if a.scene else "built in",
                  "options": a.bake, "runs": night.runs, "interruptions": night.events, "same_hash": same,
                  "content_hash": report and report["content_hash"], "photons": report and report["photons"],
                  "machine": report and report.get("host", {"cpu": platform.processor()})}
        with open(os.path.join(a.out, "night.json"), "w", encoding="utf-8") as f:
            json.dump(result, f, indent=2)
            f.write("\n")
        return 0 if same and not night.failed else 1
    finally:
        for process in (night.process, night.other):
            if process is not None and process.poll() is None:
                process.kill()
                process.wait()
        place.close()


if __name__ == "__main__":
    sys.exit(main())
