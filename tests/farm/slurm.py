#!/usr/bin/env python3
"""A Slurm cluster of two nodes on this machine renders an exported turntable; a task is stopped, a node is killed.

    python3 tests/farm/slurm.py [--turntable target/release/turntable] [--keep]

Takes three to six minutes, of which two are Slurm's own waiting before it starts a dead node's job again; too long
for every change, and it needs Slurm: `apt-get install slurm-wlm munge` (Debian 12 and later, Ubuntu 22.04 and later).
The cluster has its own key, sockets, ports and folder, below a temporary folder that goes away; nothing of the
machine is configured, no service is started, and a cluster that is there already is not touched. Root is not needed:
all daemons run as whoever starts this, and Slurm then runs jobs of that user only.

What happens: the turntable is rendered undisturbed; it is exported (`turntable farm export --slurm`) and submitted
with `sh`; when frames are being written, the task on the first node is told to stop, as Slurm tells it when its time
is nearly up, and exits with 75; then the second node's daemon and everything it started are killed with SIGKILL; the
node stays dead. What must come of it: Slurm queues both tasks again, every frame is there with the pixels and the
digest of the undisturbed run, and so are the contact sheet and the report.

Exit code 0: so it came. 1: not so. 2: could not be tried (Slurm is missing, a daemon did not start).
"""

import argparse
import getpass
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import exr_bits

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "scontrol", "sinfo", "squeue"]
PIPELINE = """\
version: 1
name: two nodes
groom: {sample: {style: wavy, strands: 300, points: 12}}
convert: [groom.txt]
lights: {environment: {constant: [1, 0.9, 0.8]}}
turntable: {frames: 12}
render: {width: 96, height: 96, spp: SPP, max_bounces: 32, aovs: [R]}
sheet: {columns: 4, gap: 2}
"""


class CouldNot(Exception):
    """The trial itself failed; says nothing about the renderer."""


def say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def free_ports(count: int) -> list[int]:
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class Cluster:
    """munged, slurmctld and two slurmd, all below one folder."""

    NODES = ["n1", "n2"]

    def __init__(self, folder: Path):
        self.folder = folder
        self.daemons: dict[str, subprocess.Popen] = {}
        folder.mkdir()
        for name in ["run", "log", "state", "spool-n1", "spool-n2"]:
            (folder / name).mkdir(mode=0o755)
        self.socket = folder / "run" / "munge.sock"
        self.conf = folder / "slurm.conf"
        key = folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        host, (control, one, two) = socket.gethostname().split(".")[0], free_ports(3)
        self.conf.write_text(f"""\
ClusterName=groomkit
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={control}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
AuthInfo=socket={self.socket}
CryptoType=crypto/munge
SlurmUser={getpass.getuser()}
SlurmdUser={getpass.getuser()}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/run/slurmctld.pid
SlurmdPidFile={folder}/run/slurmd-%n.pid
SlurmctldLogFile={folder}/log/slurmctld.log
SlurmdLogFile={folder}/log/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerType=sched/backfill
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmctldTimeout=30
SlurmdTimeout=10
KillWait=5
MinJobAge=3600
ReturnToService=2
JobRequeue=1
RequeueExit=75
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={one} CPUs=1 RealMemory=1000
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={two} CPUs=1 RealMemory=1000
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
""")
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf)}

    def start(self) -> None:
        run = self.folder / "run"
        self.spawn("munged", [
            "munged", "--foreground", "--force", f"--socket={self.socket}", f"--key-file={self.folder}/munge.key",
            f"--pid-file={run}/munged.pid", f"--log-file={self.folder}/log/munged.log",
            f"--seed-file={run}/munged.seed",
        ])
        self.wait("munged's socket", self.socket.exists)
        self.spawn("slurmctld", ["slurmctld", "-D", "-i", "-f", str(self.conf)])
        for node in self.NODES:
            self.spawn(node, ["slurmd", "-D", "-f", str(self.conf), "-N", node])
        self.wait("both nodes to be idle", lambda: self.ask("sinfo", "-h", "-o", "%D %t") == "2 idle")

    def spawn(self, name: str, command: list[str]) -> None:
        log = open(self.folder / "log" / f"{name}.out", "wb")
        program = program_path(command[0])
        self.daemons[name] = subprocess.Popen(
            [program, *command[1:]], env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
            start_new_session=True,
        )

    def ask(self, *command: str) -> str:
        result = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False)
        return result.stdout.strip()

    def wait(self, what: str, is_so, patience: float = 60.0) -> None:
        end = time.monotonic() + patience
        while not is_so():
            dead = [name for name, daemon in self.daemons.items() if daemon.poll() is not None]
            if dead or time.monotonic() > end:
                logs = "\n".join(tail(path) for path in sorted((self.folder / "log").iterdir()))
                raise CouldNot(f"waited for {what}; daemons that ended: {dead or 'none'}\n{logs}")
            time.sleep(0.1)

    def processes_of(self, node: str) -> list[int]:
        """Everything that a node's daemon started, jobs and their keepers too: they carry its name and our folder."""
        found = []
        for entry in Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                environment = (entry / "environ").read_bytes().split(b"\0")
            except OSError:
                continue
            ours = f"SLURM_CONF={self.conf}".encode() in environment
            if ours and f"SLURMD_NODENAME={node}".encode() in environment:
                found.append(int(entry.name))
        return found

    def kill_node(self, node: str) -> int:
        """SIGKILL to the node's daemon, the keepers of its jobs and the jobs; how many processes there were."""
        daemon = self.daemons.pop(node)
        # Keepers of jobs (slurmstepd) carry no node name of their own; they are parents of what does.
        victims = set(self.processes_of(node))
        victims |= {parent for pid in victims if (parent := parent_of(pid)) and comm(parent) == "slurmstepd"}
        victims.add(daemon.pid)
        for pid in victims:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        daemon.wait()
        return len(victims)

    def stop(self) -> None:
        self.ask("scancel", "--user", getpass.getuser())
        for name in reversed(list(self.daemons)):
            self.daemons[name].terminate()
        for name, daemon in self.daemons.items():
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
        for node in self.NODES:
            for pid in self.processes_of(node):
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass


def parent_of(pid: int) -> int | None:
    try:
        return int(Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[1])
    except OSError:
        return None


def comm(pid: int) -> str:
    try:
        return Path(f"/proc/{pid}/comm").read_text().strip()
    except OSError:
        return ""


def tail(path: Path) -> str:
    lines = path.read_text(errors="replace").splitlines()[-8:]
    return "\n".join([f"-- {path.name}", *lines])


def program_path(name: str) -> str | None:
    """Daemons often live where the path of ordinary users does not lead."""
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/usr/local/sbin:/sbin")


def job_records(cluster: Cluster) -> list[dict[str, str]]:
    records = []
    for line in cluster.ask("scontrol", "--oneliner", "show", "job").splitlines():
        words = (word.partition("=") for word in line.split() if "=" in word)
        records.append({key: value for key, _, value in words})
    return records


def trial(arguments: argparse.Namespace, folder: Path) -> bool:
    turntable = Path(arguments.turntable).resolve()
    pipeline, undisturbed, out = folder / "turn it.yaml", folder / "undisturbed", folder / "out"
    pipeline.write_text(PIPELINE.replace("SPP", str(arguments.spp)))
    start = time.monotonic()
    subprocess.run([turntable, pipeline, "--out", undisturbed, "--threads", "1"], check=True)
    alone = time.monotonic() - start
    say(f"undisturbed: {alone:.1f} s on one core")
    script = folder / "job.sbatch"
    subprocess.run(
        [turntable, "farm", "export", pipeline, "--slurm", script, "--out", out, "--chunk", "2", "--program", turntable],
        check=True,
    )
    cluster = Cluster(folder / "cluster")
    try:
        cluster.start()
        start = time.monotonic()
        said = subprocess.run(
            ["sh", script, f"--output={folder}/%x-%j.log"], cwd=folder, env=cluster.environment, check=True,
            capture_output=True, text=True,
        ).stdout
        say(said.strip().replace("\n", "; "))
        cluster.wait("the first frame", lambda: any(out.rglob("frame.*.exr")), 120)
        stopped = stop_in_mid_frame(cluster, turntable.name)
        say(f"job {stopped} stopped after {time.monotonic() - start:.1f} s, and queued again")
        killed = kill_in_mid_job(cluster, turntable.name)
        say(f"n2 killed after {time.monotonic() - start:.1f} s: {killed} processes")
        states = wait_for_the_end(cluster, arguments.patience)
        seconds = time.monotonic() - start
    finally:
        cluster.stop()
    return verdict(states, stopped, undisturbed, out, seconds, folder)


def renderers(cluster: Cluster, node: str, program: str) -> set[int]:
    """The processes that render on a node."""
    # The kernel keeps 15 letters of a name.
    return {pid for pid in cluster.processes_of(node) if comm(pid) == program[:15]}


def stop_in_mid_frame(cluster: Cluster, program: str) -> str:
    """Sends a task on the first node what `--signal=B:TERM` sends it; the job's number, when it is queued again."""
    since: dict[int, float] = {}

    def has_begun() -> bool:
        now = time.monotonic()
        for pid in renderers(cluster, "n1", program):
            since.setdefault(pid, now)
        # It has to be past its start, where a signal still ends it as any program.
        return any(comm(pid) and now - begun > 1.0 for pid, begun in since.items())
    cluster.wait("the first node to render", has_begun, 120)
    job = cluster.ask("squeue", "-h", "-r", "-w", "n1", "-t", "R", "-o", "%A").split("\n")[0]
    # It asks the controller too, again and again, until the job is running once more.
    asking = subprocess.Popen(["scancel", "--batch", "--signal=TERM", job], env=cluster.environment, stderr=subprocess.DEVNULL)

    def is_queued_again() -> bool:
        return any(record.get("JobId") == job and record.get("Restarts") == "1" for record in job_records(cluster))
    try:
        cluster.wait(f"job {job} to be queued again", is_queued_again, 60)
    finally:
        asking.kill()
        asking.wait()
    return job


def kill_in_mid_job(cluster: Cluster, program: str) -> int:
    """Waits until the second node renders, then kills it; how many processes there were."""
    cluster.wait("the second node to render", lambda: bool(renderers(cluster, "n2", program)), 120)
    return cluster.kill_node("n2")


def wait_for_the_end(cluster: Cluster, patience: float) -> list[dict[str, str]]:
    """Until no job waits or runs; the records of all jobs."""
    told, begun = "", time.monotonic()

    def is_over() -> bool:
        nonlocal told
        now = cluster.ask("squeue", "-h", "-r", "-o", "%j %T").splitlines()
        words = ", ".join(f"{now.count(line)} {line}" for line in sorted(set(now))) or "nothing left"
        if words != told:
            told = words
            say(f"  {time.monotonic() - begun:5.0f} s  {words}")
        return not now
    cluster.wait("the jobs to end", is_over, patience)
    return job_records(cluster)


def verdict(
    jobs: list[dict[str, str]], stopped: str, undisturbed: Path, out: Path, seconds: float, folder: Path
) -> bool:
    requeues = sum(int(job.get("Restarts", 0)) for job in jobs)
    bad = [f"{job.get('JobName')} {job.get('JobId')}: {job.get('JobState')}" for job in jobs
           if job.get("JobState") != "COMPLETED"]
    lost = exr_bits.differing(undisturbed, out)
    if all(job.get("JobId") == stopped or job.get("Restarts") == "0" for job in jobs):
        bad.append("no task was queued again: the node died too late, try again with more --spp")
    for name in ["sheet.png", "report.json", "report.html", "groom.txt"]:
        if not (out / name).is_file():
            bad.append(f"{name} is not there")
    if (out / "sheet.png").is_file() and (out / "sheet.png").read_bytes() != (undisturbed / "sheet.png").read_bytes():
        bad.append("sheet.png has other bytes")
    bad += [f"{path.relative_to(out)} was left" for path in out.rglob(".*") if path.is_file()]
    frames = sum(1 for _ in undisturbed.rglob("frame.*.exr"))
    say(f"{len(jobs)} jobs, {requeues} queued again, {seconds:.0f} s; {frames} frames, {len(lost)} lost or different")
    for line in bad + lost:
        say(f"  WRONG: {line}")
    if bad or lost:
        for log in sorted(folder.glob("*.log")):
            say(tail(log))
    return not bad and not lost


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--turntable", default=ROOT / "target/release/turntable", help="the program (built)")
    parser.add_argument("--spp", type=int, default=192, help="samples a pixel; more make frames take longer")
    parser.add_argument("--patience", type=float, default=900, help="seconds to wait for the jobs")
    parser.add_argument("--keep", action="store_true", help="leave the folder with logs and frames")
    arguments = parser.parse_args()
    missing = [name for name in PROGRAMS if program_path(name) is None]
    if missing:
        say(f"not there: {', '.join(missing)}; `apt-get install slurm-wlm munge`")
        return 2
    if not Path(arguments.turntable).is_file():
        say(f"{arguments.turntable} is not built: `cargo build --release --bin turntable`, or give --turntable")
        return 2
    folder = Path(tempfile.mkdtemp(prefix="groomkit-slurm-"))
    folder.chmod(0o755)
    try:
        return 0 if trial(arguments, folder) else 1
    except (CouldNot, subprocess.CalledProcessError) as error:
        say(f"could not: {error}")
        return 2
    finally:
        if arguments.keep:
            say(f"kept: {folder}")
        else:
            shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
