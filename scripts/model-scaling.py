#!/usr/bin/env python3
"""Reckons how a bake scales from 1 to 10,000 machines, from docs/data/scaling-measured.json and the assumptions in class Cluster.

  scripts/model-scaling.py [--measured FILE.json] [--csv FILE.csv] [--images FOLDER]

Prints the tables of docs/scaling.md as Markdown, writes all numbers to docs/data/scaling-model.csv and pictures to
docs/images/scaling-*.svg. The formulas are those of docs/scaling.md; simulate_tree() and simulate_chain() play the messages of a sum
one by one, to hold the formulas against.
"""
import argparse
import csv
import dataclasses
import json
import math
import os

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BLOCK = 8 * 2**20      # bytes that MPI_Reduce sums at once (mpi_sum.cpp)
SEGMENT = 128 * 2**10  # bytes that a chain passes on at once (mpi_sum_bench.c)
MACHINES = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 100, 128, 200, 256, 400, 512, 700, 1000, 1500, 2000, 3000, 5000, 7000, 10000]
TALLIES = [5e6, 100e6, 1e9, 10e9, 100e9]
PHOTONS = [1e8, 1e9, 1e10, 1e11, 1e12]
NETWORKS = [1, 10, 100]
MONTH = 30 * 86400.0


@dataclasses.dataclass
class Measured:
    """Of one core, by its CPU time."""
    photons_per_s: float
    merge_s_per_byte: float    # read, check, add
    write_s_per_byte: float    # hash and write a part, without the disk
    maps_s_per_byte: float     # light maps from tallies, files included
    add_s_per_byte: float      # in a sum over ranks
    start_s: float
    maps_memory: float         # peak memory of whoever makes light maps, in tallies
    link_efficiency: float     # of bytes summed in the bits of a link


def read_measured(path):
    data = json.load(open(path))

    def rows(section):
        return data[section]["results"]

    mid = lambda row, name: row[name]["median"]
    large = [r for r in rows("merge") if r["part"] == "50 MB" and r["parts"] >= 32]
    write = rows("write")[-1]
    mpi = {r["ranks"]: r for r in rows("mpi")}
    net = rows("network")
    pair = next(r for r in net["rows"] if r["ranks"] == 2)
    tracing = {r["scene"]: r for r in rows("tracing")}
    merge = sum(1 / mid(r, "bytes_per_cpu_s") for r in large) / len(large)
    return Measured(
        photons_per_s=mid(tracing["glossy_room"], "photons_per_user_s"),
        merge_s_per_byte=merge,
        write_s_per_byte=mid(write, "write_cpu_s") / write["part_bytes"],
        maps_s_per_byte=max(0.0, write["maps_cpu_s"] / write["part_bytes"] - merge),
        add_s_per_byte=mid(mpi[1], "add_s_per_byte"),
        start_s=mid(tracing["glossy_room"], "start_s"),
        maps_memory=write["maps_peak_bytes"] / write["part_bytes"],
        link_efficiency=min(1.0, pair["mib"] * 2**20 * 8 / (net["mbit_per_s"] * 1e6 * mid(pair, "reduce_s"))))


@dataclasses.dataclass
class Cluster:
    """What is assumed and not measured."""
    network_gbit: float = 10     # of each machine's link, each way; the switches carry all links at once
    disk: float = 1e9            # bytes/s of a machine's reading or writing
    shared: float = 20e9         # bytes/s of the common file system, all machines together
    cores: int = 32
    latency: float = 30e-6       # s, of a message
    job_start: float = 5         # s, until a job of a cluster runs; once a level of a tree of merges
    memory: float = 128e9
    large_tallies: float = 1.34  # tracing time with tallies of 1 GB and more, relative to 16 MB and less
    piece: float = 1             # s of work that a rank is dealt at a time (range_dealer.h)


class Model:
    def __init__(self, measured, cluster):
        self.m, self.c = measured, cluster
        self.net = cluster.network_gbit * 1e9 / 8 * measured.link_efficiency

    def with_(self, **changes):
        return Model(self.m, dataclasses.replace(self.c, **changes))

    def slowed(self, tally):
        share = math.log(max(tally, 16e6) / 16e6) / math.log(1e9 / 16e6)
        return self.c.large_tallies ** min(1.0, share)

    def rate(self, tally):
        """Photons per second of one machine."""
        return self.c.cores * self.m.photons_per_s / self.slowed(tally)

    def trace(self, machines, tally, photons):
        """Without the start of the program (measured: under a second)."""
        return photons / (machines * self.rate(tally))

    # Sums over ranks, to rank 0.

    @staticmethod
    def hops(machines):
        """How often rank 0 receives a block: Open MPI 4.1 takes them one by one from 4 to 7 ranks, a chain below, a binomial tree
        above, without cutting blocks into segments."""
        if machines < 4:
            return min(1, machines - 1)
        return machines - 1 if machines < 8 else math.ceil(math.log2(machines))

    def sum_mpi(self, machines, tally):
        blocks = math.ceil(tally / BLOCK)
        return self.hops(machines) * (tally * (1 / self.net + self.m.add_s_per_byte) + blocks * self.c.latency)

    def sum_chain(self, machines, tally):
        if machines == 1:
            return 0.0
        step = self.c.latency + SEGMENT * (1 / self.net + self.m.add_s_per_byte)
        return tally * max(1 / self.net, self.m.add_s_per_byte, self.c.latency / SEGMENT) + (machines - 1) * step

    def sum_scatter(self, machines, tally):
        if machines == 1:
            return 0.0
        share = (machines - 1) / machines
        pieces = math.ceil(tally / 2**30)
        return tally * share * (2 / self.net + self.m.add_s_per_byte) + pieces * 2 * math.ceil(math.log2(machines)) * self.c.latency

    # Merges of parts.

    def read_s_per_byte(self, readers=1):
        return max(1 / self.net, 1 / self.c.disk, self.m.merge_s_per_byte / readers)

    def merge_one(self, parts, tally, readers=1):
        return parts * tally * max(self.read_s_per_byte(readers), 1 / self.c.shared)

    def save(self, tally):
        """A part, or a checkpoint: hashed, written, flushed."""
        return tally * (self.m.write_s_per_byte + 1 / self.c.disk)

    def merge_tree(self, parts, tally, fan, readers=1):
        """Levels of cluster jobs, each merging up to `fan` parts into one."""
        seconds, left = 0.0, parts
        while left > 1:
            merges = math.ceil(left / fan)
            one = min(fan, left) * tally * self.read_s_per_byte(readers) + (self.save(tally) if merges > 1 else 0)
            bytes_moved = (left + (merges if merges > 1 else 0)) * tally
            seconds += self.c.job_start + max(one, bytes_moved / self.c.shared)
            left = merges
        return seconds

    def best_tree(self, parts, tally, readers=1):
        """(seconds, fan): the best fan-in; that of all parts at once is one merge."""
        fans = sorted({f for f in list(range(2, 65)) + [128, 256, 512, parts] if 2 <= f <= max(2, parts)})
        return min((self.merge_tree(parts, tally, f, readers), f) for f in fans)

    def maps(self, tally):
        return tally * self.m.maps_s_per_byte

    # Checkpoints: the share of the time that they take.

    def checkpoint_mpi(self, machines, tally, counted):
        """`counted`: the interval is stretched for the sum, too, and not only for the writing."""
        total = self.sum_mpi(machines, tally)
        save = self.save(tally)
        interval = max(300, 50 * (save + (total if counted else 0)))
        cost = total + save + self.c.piece / 2
        return cost / (interval + cost), interval, cost

    def checkpoint_parts(self, machines, tally):
        """On the common file system, which all machines write to at the same time."""
        save = max(self.save(tally), machines * tally / self.c.shared)
        interval = max(300, 50 * save)
        return save / (interval + save), interval, save

    # Machines that die: time divided by the time without deaths, of a bake that takes `trace` seconds of tracing.

    def failures_mpi(self, machines, tally, mtbf, restart=60, counted=True):
        """A death ends all ranks; all go back to the last state. Exact for exponential lifetimes, interval by interval (Daly 2006)."""
        _, interval, cost = self.checkpoint_mpi(machines, tally, counted)
        rate = machines / mtbf
        exponent = rate * (interval + cost)
        if exponent > 50:
            return math.inf
        return (1 / rate + restart) * math.expm1(exponent) / interval

    def failures_parts(self, machines, tally, mtbf, trace, parts_per_machine, states_survive, restart=60):
        """A death costs what one machine did since its last state (or, with states on the dead machine's own disk, on its part), which
        another does again; with parts enough that is spread, else the last machine is waited for."""
        share, interval, _ = self.checkpoint_parts(machines, tally) if states_survive else (0.02, trace / parts_per_machine, 0)
        lost = min(interval, trace / parts_per_machine) / 2 + restart
        deaths = machines * trace / mtbf
        spread = deaths * lost / (machines * trace)
        waited = (1 - math.exp(-deaths)) * min(lost, trace) / parts_per_machine / trace if parts_per_machine > 1 \
            else (1 - math.exp(-deaths)) * lost / trace
        return (1 + spread + waited) / (1 - share)

    # Tallies larger than a machine.

    def passes_needed(self, tally):
        return max(1, math.ceil(self.m.maps_memory * tally / (self.c.memory - 2e9)))

    def passes(self, machines, tally, photons, groups, total=None):
        """G groups of charts, each baked by machines/G machines at the same time (or one after another, when there are fewer)."""
        teams = max(1, machines // groups)
        rounds = math.ceil(groups / machines) if machines < groups else 1
        total = total or self.sum_mpi
        return rounds * (self.trace(teams, tally / groups, photons) + total(teams, tally / groups) + self.maps(tally / groups))

    def best_passes(self, machines, tally, photons, total=None):
        least = self.passes_needed(tally)
        options = sorted({g for g in range(least, max(least, min(machines, 400)) + 1)})
        return min((self.passes(machines, tally, photons, g, total), g) for g in options)

    def routed(self, machines, tally, photons, hits=3, hit_bytes=40):
        """Each rank owns a part of the tallies; hits go to their owner while photons are traced. No sum."""
        own = tally / machines
        sent = photons / machines * hits * hit_bytes * (machines - 1) / machines
        return max(self.trace(machines, own, photons), sent / self.net) + self.maps(tally) / machines + tally / self.c.shared


def crossover(total, trace):
    """The least number of machines from which on, up to 10,000, the sum takes at least as long as the tracing; None: at no number.
    The sum is not monotonous (7 ranks take longer than 8), so this looks at all numbers, coarsely above 64."""
    found = None
    for n in reversed(COUNTS):
        if total(n) < trace(n):
            return found
        found = n
    return found


COUNTS = sorted({*range(2, 65), *(round(64 * 1.02**k) for k in range(256)), 10000})
COUNTS = [n for n in COUNTS if n <= 10000]


# Sums played message by message.

def simulate_tree(ranks, tally, net, add, latency, block=BLOCK):
    """A binomial tree; a rank takes its children's blocks one after another, and sends a block only when its parent takes it."""
    free = [0.0] * ranks
    blocks = math.ceil(tally / block)
    for _ in range(blocks):
        for rank in range(ranks - 1, -1, -1):
            step = 1
            while rank % (2 * step) == 0 and rank + step < ranks:
                child = rank + step
                free[rank] = max(free[rank], free[child]) + latency + block / net
                free[child] = free[rank]  # what it sent is gone: on to its next block
                free[rank] += block * add
                step *= 2
    return free[0]


def simulate_chain(ranks, tally, net, add, latency, segment=SEGMENT):
    segments = math.ceil(tally / segment)
    sent = [0.0] * segments  # when the rank before (farther from the root) has sent each
    for _ in range(1, ranks):
        link = 0.0  # when the link is free
        mine = []
        for s in range(segments):
            link = max(link, sent[s]) + segment / net
            mine.append(link + latency + segment * add)
        sent = mine
    return sent[-1]


# Pictures.

COLOURS = ["#1b1b1b", "#c0392b", "#2471a3", "#1e8449", "#b9770e", "#7d3c98", "#5f6a6a"]
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Chart:
    """Lines on logarithmic axes, as SVG."""
    left, top, width, height = 78, 46, 520, 330

    def __init__(self, title, x_label, y_label, x_range, y_range):
        self.title, self.x_label, self.y_label = title, x_label, y_label
        self.x_range, self.y_range = x_range, y_range
        self.marks, self.legend = [], []

    def x(self, value):
        low, high = map(math.log10, self.x_range)
        return self.left + self.width * (math.log10(value) - low) / (high - low)

    def y(self, value):
        low, high = map(math.log10, self.y_range)
        return self.top + self.height * (1 - (math.log10(value) - low) / (high - low))

    def line(self, name, points, colour, dash=""):
        path = " ".join(f"{self.x(x):.1f},{self.y(y):.1f}" for x, y in points if math.isfinite(y))
        style = f' stroke-dasharray="{dash}"' if dash else ""
        self.marks.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2.2"{style}/>')
        self.legend.append((name, f'<line x1="0" y1="-4" x2="26" y2="-4" stroke="{colour}" stroke-width="2.4"{style}/>'))

    def dots(self, name, points, colour, hollow=False):
        style = f'r="5" stroke="{colour}" stroke-width="2" fill="{"#fff" if hollow else colour}"'
        self.marks += [f'<circle cx="{self.x(x):.1f}" cy="{self.y(y):.1f}" {style}/>' for x, y in points]
        self.legend.append((name, f'<circle cx="13" cy="-4" {style}/>'))

    @staticmethod
    def ticks(low, high):
        first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
        values = [10.0**e for e in range(first, last + 1)]
        if last - first <= 2:
            values = [m * v for v in values for m in ((1, 2, 3, 4, 6, 8) if high < 10 else (1, 2, 5))]
        return [v for v in values if low * 0.999 <= v <= high * 1.001]

    @staticmethod
    def number(value):
        if 0.01 <= value < 100000:
            return f"{value:,.10g}"
        return "10" + str(round(math.log10(value))).translate(SUPERSCRIPT)

    def svg(self):
        right, bottom = self.left + self.width, self.top + self.height
        out = [f'<text x="{self.left}" y="26" font-size="17" font-weight="bold">{self.title}</text>']
        for v in self.ticks(*self.x_range):
            out.append(f'<line x1="{self.x(v):.1f}" y1="{self.top}" x2="{self.x(v):.1f}" y2="{bottom}" stroke="#ddd"/>')
            out.append(f'<text x="{self.x(v):.1f}" y="{bottom + 18}" text-anchor="middle">{self.number(v)}</text>')
        for v in self.ticks(*self.y_range):
            out.append(f'<line x1="{self.left}" y1="{self.y(v):.1f}" x2="{right}" y2="{self.y(v):.1f}" stroke="#ddd"/>')
            out.append(f'<text x="{self.left - 8}" y="{self.y(v) + 4:.1f}" text-anchor="end">{self.number(v)}</text>')
        out.append(f'<clipPath id="frame"><rect x="{self.left}" y="{self.top}" width="{self.width}" height="{self.height}"/></clipPath>')
        out.append('<g clip-path="url(#frame)">' + "".join(self.marks) + "</g>")
        out.append(f'<rect x="{self.left}" y="{self.top}" width="{self.width}" height="{self.height}" fill="none" stroke="#555"/>')
        out.append(f'<text x="{self.left + self.width / 2}" y="{bottom + 40}" text-anchor="middle">{self.x_label}</text>')
        out.append(f'<text transform="translate(18,{self.top + self.height / 2}) rotate(-90)" text-anchor="middle">{self.y_label}</text>')
        for i, (name, sign) in enumerate(self.legend):
            out.append(f'<g transform="translate({right + 16},{self.top + 16 + 23 * i})">{sign}<text x="34" y="0">{name}</text></g>')
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 880 430" font-family="sans-serif" font-size="13">'
                f'<rect width="880" height="430" fill="#fff"/>' + "\n".join(out) + "</svg>\n")

    def write(self, path):
        with open(path, "w") as file:
            file.write(self.svg())


# Tables.

def seconds(value):
    if not math.isfinite(value):
        return "never"
    if value < 1:
        return f"{value:.2f} s"
    if value < 120:
        return f"{value:.1f} s" if value < 10 else f"{value:.0f} s"
    if value < 7200:
        return f"{value / 60:.0f} min"
    return f"{value / 3600:.1f} h" if value < 4 * 86400 else f"{value / 86400:.0f} days"


def size(value):
    return f"{value / 1e9:g} GB" if value >= 1e9 else f"{value / 1e6:g} MB"


def table(title, head, rows):
    print(f"\n### {title}\n")
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")


def or_none(value):
    return "none" if value is None else f"{value:,}"


def ways(model):
    """name: seconds(machines, tally)"""
    return {
        "MPI_Reduce": model.sum_mpi,
        "one merge": model.merge_one,
        "one merge, 4 readers": lambda n, t: model.merge_one(n, t, 4),
        "tree of merges": lambda n, t: model.best_tree(n, t)[0] if n > 1 else 0.0,
        "MPI chain": model.sum_chain,
        "MPI scatter": model.sum_scatter,
    }


def print_measured(m):
    table("What goes in", ["quantity", "value"], [
        ["photons a second of a core, built-in room", f"{m.photons_per_s / 1e6:.2f} M"],
        ["merging, read + check + add, a core", f"{1e-9 / m.merge_s_per_byte:.2f} GB/s"],
        ["writing a part, without the disk, a core", f"{1e-9 / m.write_s_per_byte:.2f} GB/s of tallies"],
        ["light maps from tallies, a core", f"{1e-6 / m.maps_s_per_byte:.0f} MB/s of tallies"],
        ["adding in a sum over ranks", f"{1e-9 / m.add_s_per_byte:.2f} GB/s"],
        ["peak memory while maps are made", f"{m.maps_memory:.2f} times the tallies"],
        ["of a link's bits, used by a sum", f"{100 * m.link_efficiency:.0f} %"],
        ["start of the program, scene read", f"{m.start_s:.2f} s"],
    ])


def print_check(model):
    rows = []
    for ranks, tally in ((8, 1e9), (64, 1e9), (1000, 1e9), (1000, 100e6)):
        tree = simulate_tree(ranks, tally, model.net, model.m.add_s_per_byte, model.c.latency)
        chain = simulate_chain(ranks, tally, model.net, model.m.add_s_per_byte, model.c.latency)
        rows.append([ranks, size(tally), f"{tree:.2f} s", f"{model.sum_mpi(ranks, tally):.2f} s", f"{chain:.2f} s", f"{model.sum_chain(ranks, tally):.2f} s"])
    table("Formulas against messages played one by one (10 Gbit/s)",
          ["ranks", "tallies", "tree, played", "tree, formula", "chain, played", "chain, formula"], rows)


def print_sums(model):
    rows = []
    for n in (8, 64, 512, 1000, 10000):
        for t in (100e6, 1e9, 10e9):
            best, fan = model.best_tree(n, t)
            rows.append([f"{n:,}", size(t), seconds(model.merge_one(n, t)), seconds(model.merge_one(n, t, 4)), f"{seconds(best)} (f = {fan})",
                         seconds(model.sum_mpi(n, t)), seconds(model.sum_scatter(n, t)), seconds(model.sum_chain(n, t))])
    table(f"Time of the final sum, {model.c.network_gbit:g} Gbit/s",
          ["machines", "tallies", "one merge", "4 readers", "tree of merges", "MPI_Reduce", "scatter + gather", "chain"], rows)


def print_fan_in(model):
    """The fan-in that scripts/cluster/merge-tree.sh chooses, two levels from 33 parts on, against others."""
    rows = []
    for n in (32, 64, 128, 512, 1000, 10000):
        for t in (1e8, 1e9, 1e10):
            best, fan = model.best_tree(n, t)
            chosen = n if n <= 32 else math.isqrt(n - 1) + 1
            rows.append([f"{n:,}", size(t), f"{seconds(model.merge_tree(n, t, chosen))} (f = {chosen})", f"{seconds(best)} (f = {fan})"] +
                        [seconds(model.merge_tree(n, t, f)) for f in (n, 8, 16)])
    table("Fan-in of a tree of merges, 10 Gbit/s",
          ["parts", "tallies", "as chosen", "best", "one job", "f = 8", "f = 16"], rows)


def print_crossover(model):
    for name in ("one merge", "tree of merges", "MPI_Reduce", "MPI chain"):
        rows = []
        for t in TALLIES:
            cells = [or_none(crossover(lambda n, t=t: ways(model)[name](n, t), lambda n, t=t, p=p: model.trace(n, t, p))) for p in PHOTONS]
            rows.append([size(t), *cells])
        table(f"Machines at which the sum costs as much as tracing: {name}, {model.c.network_gbit:g} Gbit/s",
              ["tallies \\ photons", *(f"10{str(round(math.log10(p))).translate(SUPERSCRIPT)}" for p in PHOTONS)], rows)


def print_crossover_by_quality(model):
    rows = []
    for per_byte in (0.1, 1, 4, 10, 100, 1000):
        cells = []
        for gbit in NETWORKS:
            m = model.with_(network_gbit=gbit)
            for name in ("one merge", "tree of merges", "MPI_Reduce", "MPI chain"):
                t = 1e9
                cells.append(or_none(crossover(lambda n: ways(m)[name](n, t), lambda n: m.trace(n, t, per_byte * t))))
        rows.append([per_byte, *cells])
    head = ["photons a byte"] + [f"{g} Gbit/s: {w}" for g in NETWORKS for w in ("merge", "tree", "MPI", "chain")]
    table("The same for 1 GB, by photons per byte of tallies", head, rows)


def print_sensitivity(model):
    """1 GB, 4 photons a byte, one assumption changed at a time."""
    cases = [("as assumed", {})] + [(f"{c} cores", {"cores": c}) for c in (8, 128)] + [(f"disk {size(d)}/s", {"disk": d}) for d in (0.2e9, 2e9)]
    cases += [("100 Gbit/s and disk 10 GB/s", {"network_gbit": 100, "disk": 10e9}), ("latency 1 ms", {"latency": 1e-3}),
              ("large tallies trace as fast", {"large_tallies": 1}), ("jobs start at once", {"job_start": 0}), ("file system 100 GB/s", {"shared": 100e9})]
    rows = []
    for name, changes in cases:
        m = model.with_(**changes)
        rows.append([name] + [or_none(crossover(lambda n: f(n, 1e9), lambda n: m.trace(n, 1e9, 4e9))) for f in ways(m).values()])
    table("Crossover for 1 GB and 4 photons a byte, one assumption changed at a time", ["assumption", *ways(model)], rows)


def print_checkpoints(model):
    rows = []
    for gbit in NETWORKS:
        m = model.with_(network_gbit=gbit)
        for t in (100e6, 1e9, 10e9, 100e9):
            row = [f"{gbit} Gbit/s", size(t)]
            for n in (16, 1000):
                built, interval, _ = m.checkpoint_mpi(n, t, False)
                counted, longer, _ = m.checkpoint_mpi(n, t, True)
                row += [f"{100 * built:.1f} % every {seconds(interval)}", f"{100 * counted:.1f} % every {seconds(longer)}"]
            rows.append(row)
    table("Share of the time that MPI checkpoints take", ["network", "tallies", "16 machines, writing alone", "16, sum counted",
                                                        "1,000 machines, writing alone", "1,000, sum counted"], rows)
    rows = []
    for t in (100e6, 1e9, 10e9):
        rows.append([size(t)] + [f"{100 * share:.1f} % every {seconds(interval)}" for share, interval, _ in (model.checkpoint_parts(n, t) for n in (16, 1000, 10000))])
    table("The same for parts on a common file system of 20 GB/s", ["tallies", "16 machines", "1,000", "10,000"], rows)


def print_memory(model):
    rows = []
    for memory in (32e9, 64e9, 128e9, 256e9, 1024e9):
        usable = memory - 2e9
        rows.append([size(memory), size(float(f"{usable / model.m.maps_memory:.2g}")), size(float(f"{usable:.2g}")), size(float(f"{usable / (model.c.cores - 1 + model.m.maps_memory):.2g}")),
                     model.with_(memory=memory).passes_needed(100e9)])
    table("Largest tallies by a machine's memory", ["memory", "machine that writes", "others", "a rank on each of 32 cores", "passes for 100 GB"], rows)


def print_large(model):
    rows = []
    for t, p in ((10e9, 1e11), (100e9, 1e11), (100e9, 1e12), (1000e9, 1e13)):
        for n in (16, 100, 1000):
            row = [size(t), f"10{str(round(math.log10(p))).translate(SUPERSCRIPT)}", f"{n:,}", model.passes_needed(t)]
            for gbit in NETWORKS:
                m = model.with_(network_gbit=gbit)
                best, groups = m.best_passes(n, t, p)
                chain, chain_groups = m.best_passes(n, t, p, m.sum_chain)
                routed = m.routed(n, t, p)
                row.append(f"{seconds(best)} (G = {groups}) / {seconds(chain)} (G = {chain_groups}) / {seconds(routed)}")
            rows.append(row)
    table(f"Chart groups, summed by MPI_Reduce / by chain / routed hits; memory {size(model.c.memory)}",
          ["tallies", "photons", "machines", "G needed", *(f"{g} Gbit/s" for g in NETWORKS)], rows)


def print_failures(model):
    rows = []
    for n in (10, 100, 1000, 10000):
        row = [f"{n:,}"]
        for mtbf in (12 * MONTH, MONTH):
            row += [f"{n * 86400 / mtbf:.2g}"]
            for value in (model.failures_mpi(n, 1e9, mtbf, counted=False), model.failures_parts(n, 1e9, mtbf, 86400, 1, True),
                          model.failures_parts(n, 1e9, mtbf, 86400, 1, False), model.failures_parts(n, 1e9, mtbf, 86400, 8, False)):
                row.append("never ends" if value > 1e3 else f"{100 * (value - 1):.2g} %")
        rows.append(row)
    head = ["machines"]
    for name in ("a year", "a month"):
        head += [f"MTBF {name}: deaths a day", "MPI", "parts", "parts, states lost", "8 parts a machine, states lost"]
    table("Time added by deaths and checkpoints; a day of tracing, tallies 1 GB, 10 Gbit/s", head, rows)


def write_csv(model, path):
    with open(path, "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["network_gbit", "tally_bytes", "photons", "machines", "trace_s", "sum_mpi_s", "sum_chain_s", "sum_scatter_s", "merge_one_s",
                      "merge_tree_s", "merge_tree_fan", "maps_s", "checkpoint_share_mpi", "checkpoint_share_mpi_counted", "checkpoint_share_parts"])
        for gbit in NETWORKS:
            m = model.with_(network_gbit=gbit)
            for t in TALLIES:
                for n in (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1000, 2000, 5000, 10000):
                    tree, fan = m.best_tree(n, t) if n > 1 else (0.0, 1)
                    fixed = [m.sum_mpi(n, t), m.sum_chain(n, t), m.sum_scatter(n, t), m.merge_one(n, t), tree, fan, m.maps(t),
                             m.checkpoint_mpi(n, t, False)[0], m.checkpoint_mpi(n, t, True)[0], m.checkpoint_parts(n, t)[0]]
                    for p in PHOTONS:
                        out.writerow([gbit, f"{t:g}", f"{p:g}", n, *(f"{v:.4g}" for v in (m.trace(n, t, p), *fixed))])


def draw_measured_sum(links, images):
    """Sums over slow links in units of one transfer of all tallies."""
    chart = Chart("Sum over ranks, measured on slow links", "ranks, a link each", "time / time of one transfer of the tallies", (1.8, 9), (0.8, 8))
    ranks = [2, 3, 4, 5, 6, 7, 8]
    chart.line("formula: MPI_Reduce", [(r, Model.hops(r)) for r in ranks], COLOURS[1])
    chart.line("formula: chain", [(r, 1) for r in ranks], COLOURS[2])
    for hollow, link in enumerate(links):
        once = link["rows"][0]["mib"] * 2**20 * 8 / (link["mbit_per_s"] * 1e6)
        for name, key, colour in (("MPI_Reduce", "reduce_s", COLOURS[1]), ("chain", "chain_s", COLOURS[2]), ("scatter + gather", "scatter_gather_s", COLOURS[3])):
            chart.dots(f"{name}, {link['mbit_per_s']} Mbit/s", [(row["ranks"], row[key]["median"] / once) for row in link["rows"]], colour, hollow)
    chart.write(os.path.join(images, "scaling-sum-measured.svg"))


def draw_sums(model, images):
    t, p = 1e9, 1e11
    chart = Chart("1 GB of tallies, 10¹¹ photons, 10 Gbit/s", "machines", "seconds", (1, 10000), (0.1, 100000))
    chart.line("tracing", [(n, model.trace(n, t, p)) for n in MACHINES], COLOURS[0])
    shown = {name: f for name, f in ways(model).items() if "readers" not in name}  # more readers: the same line as one
    for (name, f), colour in zip(shown.items(), COLOURS[1:]):
        chart.line(name, [(n, f(n, t)) for n in MACHINES if n > 1], colour, "7 4" if name.endswith("scatter") else "")
    chart.write(os.path.join(images, "scaling-sum.svg"))


def draw_crossover(model, images):
    chart = Chart("Where the sum costs as much as tracing (1 GB of tallies)", "photons per byte of tallies", "machines", (0.1, 1000), (1, 10000))
    per_byte = [10 ** (k / 8) for k in range(-8, 25)]
    for gbit, dash in ((10, ""), (1, "3 3"), (100, "9 4")):
        m = model.with_(network_gbit=gbit)
        for name, colour in (("one merge", COLOURS[2]), ("MPI_Reduce", COLOURS[1]), ("MPI chain", COLOURS[5])):
            found = [(x, crossover(lambda n: ways(m)[name](n, 1e9), lambda n, x=x: m.trace(n, 1e9, x * 1e9))) for x in per_byte]
            chart.line(f"{name}, {gbit} Gbit/s", [(x, n) for x, n in found if n is not None], colour, dash)
    chart.write(os.path.join(images, "scaling-crossover.svg"))


def draw_failures(model, images):
    chart = Chart("Machines that die: a day of tracing, 1 GB, 10 Gbit/s", "machines", "time added, %", (1, 10000), (0.1, 1000))
    for name, mtbf, dash in (("a year", 12 * MONTH, ""), ("a month", MONTH, "7 4")):
        add = lambda v: 100 * (v - 1)
        chart.line(f"MPI, MTBF {name}", [(n, add(model.failures_mpi(n, 1e9, mtbf, counted=False))) for n in MACHINES], COLOURS[1], dash)
        chart.line(f"parts, MTBF {name}", [(n, add(model.failures_parts(n, 1e9, mtbf, 86400, 1, True))) for n in MACHINES], COLOURS[2], dash)
        chart.line(f"parts, states lost, {name}", [(n, add(model.failures_parts(n, 1e9, mtbf, 86400, 1, False))) for n in MACHINES], COLOURS[4], dash)
    chart.write(os.path.join(images, "scaling-failures.svg"))


def draw_large(model, images):
    t, p = 100e9, 1e12
    chart = Chart("100 GB of tallies, 10¹² photons, machines of 128 GB", "machines", "hours in all", (1, 10000), (0.05, 5000))
    for gbit, dash in ((10, ""), (1, "3 3"), (100, "9 4")):
        m = model.with_(network_gbit=gbit)
        chart.line(f"chart groups, {gbit} Gbit/s", [(n, m.best_passes(n, t, p)[0] / 3600) for n in MACHINES], COLOURS[1], dash)
        chart.line(f"routed hits, {gbit} Gbit/s", [(n, m.routed(n, t, p) / 3600) for n in MACHINES if n * m.c.memory > m.m.maps_memory * t], COLOURS[2], dash)
    chart.line("tracing alone", [(n, model.trace(n, t, p) / 3600) for n in MACHINES], COLOURS[0])
    chart.write(os.path.join(images, "scaling-large.svg"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--measured", default=os.path.join(TOP, "docs/data/scaling-measured.json"))
    parser.add_argument("--csv", default=os.path.join(TOP, "docs/data/scaling-model.csv"))
    parser.add_argument("--images", default=os.path.join(TOP, "docs/images"))
    arguments = parser.parse_args()
    model = Model(read_measured(arguments.measured), Cluster())
    print_measured(model.m)
    print_check(model)
    print_sums(model)
    print_fan_in(model)
    print_crossover(model)
    print_crossover_by_quality(model)
    print_sensitivity(model)
    print_checkpoints(model)
    print_memory(model)
    print_large(model)
    print_failures(model)
    write_csv(model, arguments.csv)
    data = json.load(open(arguments.measured))
    draw_measured_sum([data[name]["results"] for name in ("network", "network_slow") if name in data], arguments.images)
    draw_sums(model, arguments.images)
    draw_crossover(model, arguments.images)
    draw_failures(model, arguments.images)
    draw_large(model, arguments.images)


if __name__ == "__main__":
    main()
