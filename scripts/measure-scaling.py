#!/usr/bin/env python3
"""Measures what sharing a bake over machines costs, on the machine where it runs, and writes docs/data/scaling-measured.json.

  scripts/measure-scaling.py [--lucarne PROGRAM] [--output FILE.json] [--folder FOLDER] [--only SECTION,SECTION…]

Sections: merge (adding up parts), write (a part, or a checkpoint), mpi (the sum over ranks), network and network_slow (the same
over links of 200 and 50 Mbit/s between network namespaces, as root), tracing. All but network_slow is repeated three times in
turn; the file has medians and the smallest and largest. What is missing (mpirun, mpicc, the right to make namespaces) is named
and left out. It takes six to eight minutes, keeps all cores busy for some of them, and takes up to 7 GB in FOLDER (default
/tmp/scaling), which are removed. Files are "cold" when their own pages have been dropped from the cache; other files are left
alone.
"""
import argparse
import json
import os
import platform
import shutil
import subprocess
import sys
import time

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SCENE = os.path.join(TOP, "scenes/cornell_box.glb")
REPETITIONS = 3
COUNTS = (2, 8, 32, 128)
SIZES = {"5 MB": 92, "50 MB": 296}  # texels per metre in the Cornell box
COLD_BYTES = 1_700_000_000
LINK_MIB = 16
LINKS = {"network": (200, (2, 4, 8), REPETITIONS), "network_slow": (50, (2, 8), 1)}  # Mbit/s, ranks, repetitions
NAMESPACES = "setpriv --pdeathsig KILL unshare --net --pid --fork --kill-child --mount --mount-proc --uts".split()


def say(text):
    print(f"measure-scaling: {text}", file=sys.stderr, flush=True)


def median(values):
    values = sorted(values)
    return values[len(values) // 2]


def spread(values):
    return {"median": median(values), "smallest": min(values), "largest": max(values)}


def timed(command, **more):
    """Wall seconds, CPU seconds and peak resident bytes of a command that must succeed; timed.user is its user time."""
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **more)
    error = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.monotonic() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"measure-scaling: {' '.join(command[:6])} … failed: {error.decode()[-500:]}")
    timed.user = usage.ru_utime
    return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def drop(paths):
    """Takes the files out of the page cache; their pages must be on disk."""
    for path in paths:
        descriptor = os.open(path, os.O_RDONLY)
        os.posix_fadvise(descriptor, 0, 0, os.POSIX_FADV_DONTNEED)
        os.close(descriptor)


class Series:
    """Numbers of repeated runs by name."""

    def __init__(self):
        self.values = {}

    def add(self, **numbers):
        for name, value in numbers.items():
            self.values.setdefault(name, []).append(value)

    def result(self):
        return {name: spread(values) for name, values in self.values.items()}


class Bench:
    def __init__(self, lucarne, folder):
        self.lucarne, self.folder = lucarne, folder

    def path(self, name):
        return os.path.join(self.folder, name)

    def bake(self, out, begin, end, density, *more):
        return timed([self.lucarne, "bake", SCENE, "-o", out, "--photons", "1G", "--photon-range", f"{begin}:{end}",
                      "--keep-all-directions", "--density", str(density), "--texels", "400M", "--checkpoint", "0", "--quiet", *more])

    def merge(self, parts, *more):
        listing = self.path("list.txt")
        with open(listing, "w") as file:
            file.write("\n".join(parts) + "\n")
        return timed([self.lucarne, "merge", "@" + listing, "--quiet", *more])

    def cat(self, parts):
        return timed(["cat", *parts])

    def write_with_dd(self, source):
        out = self.path("dd.bin")
        wall, _, _ = timed(["dd", "if=" + source, "of=" + out, "bs=1M", "conv=fsync"])
        os.remove(out)
        return wall


def measure_merge(bench):
    """Seconds to merge N parts into one part, warm and cold, beside cat of the same files."""
    rows = []
    for label, density in SIZES.items():
        parts = [bench.path(f"{i}.part") for i in range(max(COUNTS))]
        for i, part in enumerate(parts):
            bench.bake(part, 100 * i, 100 * (i + 1), density)
        size = os.path.getsize(parts[0])
        series = {n: Series() for n in COUNTS}
        for _ in range(REPETITIONS):
            for n in COUNTS:
                measure_merge_once(bench, parts[:n], size, series[n])
        for n in COUNTS:
            rows.append({"part": label, "part_bytes": size, "parts": n, **series[n].result()})
        say(f"merged parts of {size / 1e6:.1f} MB")
        for part in parts:
            os.remove(part)
    return rows


def measure_merge_once(bench, parts, size, series):
    out, total = bench.path("all.part"), size * len(parts)
    cat_wall, cat_cpu, _ = bench.cat(parts)
    wall, cpu, peak = bench.merge(parts, "-o", out)
    verify, verify_cpu, verify_peak = bench.merge(parts, "--verify")
    series.add(cat_s=cat_wall, merge_s=wall, merge_cpu_s=cpu, verify_s=verify, verify_cpu_s=verify_cpu, peak_bytes=peak, verify_peak_bytes=verify_peak,
               bytes_per_s=total / wall, bytes_per_cpu_s=total / cpu, cat_bytes_per_s=total / cat_wall)
    if total <= COLD_BYTES:
        drop(parts)
        cold_cat, _, _ = bench.cat(parts)
        drop(parts)
        cold, _, _ = bench.merge(parts, "-o", out)
        series.add(cold_cat_s=cold_cat, cold_merge_s=cold, cold_bytes_per_s=total / cold, cold_cat_bytes_per_s=total / cold_cat)
    os.remove(out)


def measure_write(bench):
    """What writing a part costs: a merge of one part that writes it less one that only reads it; and light maps made of it."""
    rows = []
    for density in (296, 900):
        part, out, series = bench.path("one.part"), bench.path("copy.part"), Series()
        bench.bake(part, 0, 100, density)
        size = os.path.getsize(part)
        for _ in range(REPETITIONS):
            dd = bench.write_with_dd(part)
            read, read_cpu, _ = bench.merge([part], "--verify")
            both, both_cpu, _ = bench.merge([part], "-o", out)
            series.add(dd_fsync_s=dd, write_s=both - read, write_cpu_s=both_cpu - read_cpu, dd_bytes_per_s=size / dd,
                       write_bytes_per_s=size / max(both - read, 1e-6))
        maps, maps_cpu, maps_peak = bench.merge([part], "-o", bench.path("maps.dlm"))
        rows.append({"part_bytes": size, "maps_s": maps, "maps_cpu_s": maps_cpu, "maps_peak_bytes": maps_peak, **series.result()})
        os.remove(part)
        os.remove(out)
        shutil.rmtree(bench.path("maps.dlm"))
        say(f"wrote parts of {size / 1e6:.1f} MB")
    return rows


def mpi_environment():
    return {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def build_sum_bench(folder):
    program = os.path.join(folder, "mpi_sum_bench")
    subprocess.run(["mpicc", "-O2", os.path.join(TOP, "tests/bench/mpi_sum_bench.c"), "-o", program], check=True)
    return program


def run_sum_bench(program, ranks, mib, *mpirun_options):
    # Ranks that wait let others run: here there are more of them than cores.
    command = ["mpirun", "-n", str(ranks), "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", *mpirun_options, program, str(mib), "1"]
    done = subprocess.run(command, capture_output=True, text=True, env=mpi_environment(), stdin=subprocess.DEVNULL, timeout=200)
    if done.returncode != 0:
        raise RuntimeError(done.stderr[-500:])
    return json.loads(done.stdout.strip().splitlines()[-1])


def sum_rows(results):
    rows = []
    for ranks, runs in sorted(results.items()):
        row = {"ranks": ranks, "mib": runs[0]["mib"]}
        for name in ("reduce_s", "scatter_gather_s", "chain_s", "latency_s", "add_s_per_byte"):
            row[name] = spread([run[name] for run in runs])
        rows.append(row)
    return rows


def measure_mpi(bench):
    """All ranks on this machine: with more ranks than cores, this is the work of the processors, not the time of a network."""
    program = build_sum_bench(bench.folder)
    results = {}
    for _ in range(REPETITIONS):
        for ranks in (1, 2, 4, 8):
            results.setdefault(ranks, []).append(run_sum_bench(program, ranks, 64))
    say("summed over ranks on this machine")
    return sum_rows(results)


def measure_network(bench, section="network"):
    """The same between network namespaces whose links are made slow."""
    build_sum_bench(bench.folder)
    done = subprocess.run([*NAMESPACES, sys.executable, os.path.abspath(__file__), "--folder", bench.folder, "--inside-namespaces", section],
                          stdout=subprocess.PIPE, stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        say(f"{section} left out: it did not run")
        return None
    say(f"summed over links of {LINKS[section][0]} Mbit/s")
    return {"mbit_per_s": LINKS[section][0], "repetitions": LINKS[section][2], "rows": json.loads(done.stdout)}


def measure_network_slow(bench):
    """Slower links: what the crowd of ranks on few cores costs weighs less, so this is nearer to machines of their own."""
    return measure_network(bench, "network_slow")


def ip(*words):
    subprocess.run(["ip", *words], check=True)


def limit(device, mbit, *prefix):
    """No faster than the link; the queue is long, so that TCP is slowed down and not cut."""
    subprocess.run([*prefix, "tc", "qdisc", "add", "dev", device, "root", "tbf", "rate", f"{mbit}mbit", "burst", "64kb", "latency",
                    "100ms"], check=True)


def make_machines(count, mbit):
    subprocess.run(["mount", "-t", "tmpfs", "tmpfs", "/run"], check=True)
    ip("link", "set", "lo", "up")
    ip("link", "add", "bridge0", "type", "bridge")
    ip("address", "add", "10.99.0.254/24", "dev", "bridge0")
    ip("link", "set", "bridge0", "up")
    for i in range(1, count + 1):
        name = f"m{i}"
        ip("netns", "add", name)
        ip("link", "add", f"to-{name}", "type", "veth", "peer", "name", "eth0", "netns", name)
        ip("link", "set", f"to-{name}", "master", "bridge0", "up")
        ip("-n", name, "link", "set", "lo", "up")
        ip("-n", name, "address", "add", f"10.99.0.{i}/24", "dev", "eth0")
        ip("-n", name, "link", "set", "eth0", "up")
        limit(f"to-{name}", mbit)
        limit("eth0", mbit, "ip", "netns", "exec", name)


def inside_namespaces(folder, section):
    mbit, rank_counts, repetitions = LINKS[section]
    make_machines(max(rank_counts), mbit)
    agent = os.path.join(folder, "agent.sh")  # what mpirun calls in place of ssh: HOST COMMAND…
    with open(agent, "w") as file:
        file.write('#!/bin/sh\nhost=$1\nshift\nexec ip netns exec "$host" unshare --uts sh -c "hostname $host; $*"\n')
    os.chmod(agent, 0o755)
    results = {}
    for _ in range(repetitions):
        for ranks in rank_counts:
            hosts = ",".join(f"m{i}:1" for i in range(1, ranks + 1))
            run = run_sum_bench(os.path.join(folder, "mpi_sum_bench"), ranks, LINK_MIB, "--host", hosts, "--mca", "plm_rsh_agent", agent,
                                "--mca", "plm_rsh_no_tree_spawn", "1", "--mca", "btl", "tcp,self", "--mca", "oob_tcp_if_include",
                                "10.99.0.0/24", "--mca", "btl_tcp_if_include", "10.99.0.0/24")
            results.setdefault(ranks, []).append(run)
    print(json.dumps(sum_rows(results)))


def measure_tracing(bench):
    """Photons per second of a core, start-up, and how the rate falls as tallies outgrow the caches.

    The rate is that between two numbers of photons, in user time: the first photons touch the pages of the tallies, which the
    system then makes, once, at a cost that would pass for tracing (five seconds for 1.6 GB).
    """
    out, report = bench.path("trace.part"), bench.path("report.json")

    def run(scene, photons, *more):
        wall, cpu, peak = timed([bench.lucarne, "bake", *scene, "-o", out, "--photons", "1G", "--photon-range", f"0:{photons}",
                                 "--threads", "1", "--checkpoint", "0", "--report", report, "--quiet", *more])
        os.remove(out)
        return wall, cpu, peak, timed.user, json.load(open(report))

    deep = ["--keep-all-directions", "--texels", "400M"]
    cases = {"glossy_room": ([], []), "cornell_box": ([SCENE], []), "two_lamps": ([os.path.join(TOP, "scenes/two_lamps.glb")], [])}
    for name, density in (("4 MB", 83), ("1.6 GB", 1670)):
        cases["cornell_box, tallies " + name] = ([SCENE], ["--density", str(density), *deep])
    series = {name: Series() for name in cases}
    for _ in range(REPETITIONS):
        for name, (scene, more) in cases.items():
            few, many = (1_000_000, 2_500_000) if more else (200_000, 1_200_000)
            if more == []:
                start_wall, start_cpu, _, _, _ = run(scene, 1)
                series[name].add(start_s=start_wall, start_cpu_s=start_cpu)
            _, _, _, user_few, _ = run(scene, few, *more)
            _, cpu, peak, user_many, r = run(scene, many, *more)
            if user_many > user_few:
                series[name].add(photons_per_user_s=(many - few) / (user_many - user_few))
            series[name].add(cpu_s=cpu, peak_bytes=peak,
                             tally_bytes=r["tally_bytes"], hits_per_photon=r["stored_hits"] / many)
    say("traced")
    # A difference that noise has turned round at any time tells nothing.
    rows = []
    for name, s in series.items():
        if len(s.values.get("photons_per_user_s", [])) < REPETITIONS:
            say(f"the rate of {name} drowned in noise")
            s.values.pop("photons_per_user_s", None)
        rows.append({"scene": name, **s.result()})
    return rows


def missing_for(section, lucarne):
    need = {"merge": [lucarne], "write": [lucarne], "tracing": [lucarne], "mpi": ["mpirun", "mpicc"],
            "network": ["mpirun", "mpicc", "unshare", "setpriv", "ip", "tc"]}[section.removesuffix("_slow")]
    absent = [name for name in need if shutil.which(name) is None]
    if not absent and section.startswith("network") and subprocess.run([*NAMESPACES, "true"], stderr=subprocess.DEVNULL).returncode != 0:
        absent.append("the right to make namespaces")
    return absent


def processor():
    try:
        with open("/proc/cpuinfo") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def main():
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    sections = {"merge": measure_merge, "write": measure_write, "mpi": measure_mpi, "network": measure_network,
                "network_slow": measure_network_slow, "tracing": measure_tracing}
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--lucarne", default=os.path.join(TOP, "build/release/cli/lucarne"))
    parser.add_argument("--output", default=os.path.join(TOP, "docs/data/scaling-measured.json"))
    parser.add_argument("--folder", default="/tmp/scaling")
    parser.add_argument("--only", default=",".join(sections), help="sections; others in FILE.json are kept")
    parser.add_argument("--inside-namespaces", metavar="SECTION", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.inside_namespaces:
        return inside_namespaces(arguments.folder, arguments.inside_namespaces)
    os.makedirs(os.path.dirname(os.path.abspath(arguments.output)), exist_ok=True)
    result = json.load(open(arguments.output)) if os.path.exists(arguments.output) else {}
    os.makedirs(arguments.folder, exist_ok=True)
    folder = os.path.join(arguments.folder, f"run-{os.getpid()}")
    os.mkdir(folder)
    try:
        bench = Bench(arguments.lucarne, folder)
        for section in arguments.only.split(","):
            absent = missing_for(section, arguments.lucarne)
            if absent:
                say(f"{section} left out: {', '.join(absent)} missing")
                continue
            start, load = time.monotonic(), os.getloadavg()[0]
            rows = sections[section](bench)
            result[section] = {"load": round(load, 1), "took_s": round(time.monotonic() - start, 1), "results": rows}
        result["machine"] = {"processor": processor(), "cores": os.cpu_count(), "repetitions": REPETITIONS}
        with open(arguments.output, "w") as file:
            json.dump(result, file, indent=1)
            file.write("\n")
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
