"""A Slurm of one's own: munged, slurmctld and slurmd on this machine, from private folders and ports."""

import ctypes
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from pathlib import Path

# No accounting, control groups or nodes health: only what a job array and a dependency need. The
# pauses are those of a scheduler with nothing else to do.
CONFIGURATION = """\
ClusterName=sward
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={control_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0
SlurmdParameters=config_overrides
MpiDefault=none
SwitchType=switch/none
MailProg=/bin/true
KillWait=2
NodeName=tiles NodeHostname={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=1024 State=UNKNOWN
PartitionName=all Nodes=tiles Default=YES MaxTime=INFINITE State=UP
"""

# Looked up before any fork. The number is from linux/prctl.h.
LIBC = ctypes.CDLL(None)
PR_SET_PDEATHSIG = 1

STARTING = 20.0  # [s] until the node must be ready, on a busy machine
ENDING = 5.0  # [s] that a daemon has to end by itself


class LoopbackSlurm:
    """Runs from the constructor, which throws with the daemons' logs, until close()."""

    def __init__(self):
        # Its own short path: the name of a socket has at most 107 bytes.
        self.folder = Path(tempfile.mkdtemp(prefix="sward-slurm-", dir="/tmp"))
        self.daemons = []
        self.environment = {**os.environ, "PATH": search_path(),
                            "SLURM_CONF": str(self.folder / "slurm.conf")}
        try:
            self.start()
        except BaseException:
            self.close()
            raise

    def start(self):
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        control_port, node_port = free_ports(2)
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            folder=self.folder, host=socket.gethostname().split(".")[0], user=user_name(),
            control_port=control_port, node_port=node_port), encoding="ascii")
        self.daemon("munged", "--foreground", "--force", f"--key-file={key}",
                    *(f"--{what}={self.folder}/munge.{end}" for what, end in
                      (("socket", "socket"), ("pid-file", "pid"), ("log-file", "log"),
                       ("seed-file", "seed"))))
        self.wait_for(lambda: (self.folder / "munge.socket").exists(), "munged opens its socket")
        self.daemon("slurmctld", "-D", "-c", "-f", self.folder / "slurm.conf")
        self.daemon("slurmd", "-D", "-c", "-f", self.folder / "slurm.conf")
        self.wait_for(lambda: self.ask("sinfo", "--noheader", "--format=%T", code=None) == "idle\n",
                      "the node is idle")

    def daemon(self, *command):
        with open(self.folder / f"{command[0]}.out", "wb") as out:
            self.daemons.append(subprocess.Popen(
                list(map(str, command)), env=self.environment, stdin=subprocess.DEVNULL, stdout=out,
                stderr=out, start_new_session=True, preexec_fn=die_with_the_test))

    def wait_for(self, reached, what):
        deadline = time.monotonic() + STARTING
        while not reached():
            dead = [daemon.args[0] for daemon in self.daemons if daemon.poll() is not None]
            if dead or time.monotonic() > deadline:
                raise RuntimeError(f"Slurm cannot run here: {what}: never; ended: {dead or 'none'}\n"
                                   + self.logs())
            time.sleep(0.05)

    def ask(self, *command, code=0):
        """Output of a Slurm command that must end with `code` (None: any)."""
        done = subprocess.run(list(map(str, command)), env=self.environment, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL)
        if code is not None and done.returncode != code:
            raise RuntimeError(f"{command}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def logs(self):
        return "\n".join(f"--- {path.name}\n" + path.read_text(errors="replace")[-3000:]
                         for pattern in ("*.log", "*.out")
                         for path in sorted(self.folder.glob(pattern)))

    def close(self):
        """Ends the daemons, then jobs and whatever else knows this Slurm; removes its folder."""
        while self.daemons:
            daemon = self.daemons.pop()
            daemon.terminate()
            try:
                daemon.wait(ENDING)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        # Again and again, since a process may have made another in the meantime.
        deadline = time.monotonic() + ENDING
        while (left := self.processes()) and time.monotonic() < deadline:
            for process in left:
                try:
                    os.kill(process, signal.SIGKILL)
                except ProcessLookupError:
                    pass
        shutil.rmtree(self.folder, ignore_errors=True)

    def processes(self):
        """Processes of this Slurm and its jobs: all that inherited its configuration."""
        mark = f"SLURM_CONF={self.folder}/slurm.conf".encode()
        found = []
        for path in Path("/proc").glob("[0-9]*"):
            try:
                if mark in (path / "environ").read_bytes().split(b"\0"):
                    found.append(int(path.name))
            except OSError:
                pass  # it has ended, or is another user's
        return found


def die_with_the_test():
    """In the child: SIGKILL when the parent ends, however it ends."""
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def search_path():
    """Daemons lie where a user's PATH does not look."""
    return os.environ.get("PATH", "") + ":/usr/sbin:/usr/local/sbin"


def user_name():
    """Name of the user that the daemons run as; Slurm takes numbers too."""
    return str(os.getuid())


def free_ports(count):
    """Unused ports."""
    sockets = [socket.socket() for _ in range(count)]
    try:
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]
    finally:
        for one in sockets:
            one.close()
