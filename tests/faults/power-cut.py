#!/usr/bin/env python3
"""Cuts the power under a program that writes a store. NEEDS ROOT: it mounts file systems.

Each round, an ext4 file system on a loop device is shut down by ioctl while the writer writes (what was not
synced is gone, as when the power goes), mounted again, and the store on it is opened and compared with what the
writer said was done. Every fifth round begins with a new store, the others go on with the old one.

Usage: sudo tests/faults/power-cut.py [ROUNDS]. STORE_TEST_BINARY names a test binary that is built already.
"""
import fcntl, os, random, re, shutil, struct, subprocess, sys, tempfile, threading, time

SHUTDOWN, NO_LOG_FLUSH = 0x8004587D, 2  # EXT4_IOC_SHUTDOWN


def test_binary(root):
    out = subprocess.run(
        ["cargo", "test", "--test", "all", "--no-run"], cwd=root, capture_output=True, text=True, check=True
    ).stderr
    return os.path.join(root, out.rsplit("(", 1)[1].split(")")[0])


def run(binary, test, **env):
    return subprocess.Popen(
        [binary, "--exact", f"store_faults::{test}", "--nocapture"],
        env={**os.environ, **env}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
    )


def listen(writer, done):
    for line in writer.stdout:
        if line.startswith("done "):
            done.append(int(line.split()[1]))


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
    binary = os.environ.get("STORE_TEST_BINARY") or test_binary(root)
    work = tempfile.mkdtemp()
    # A copy, since a build meanwhile would put another in its place.
    binary = shutil.copy(binary, os.path.join(work, "writer"))
    image, mount = os.path.join(work, "disk.img"), os.path.join(work, "disk")
    os.mkdir(mount)
    dice = random.Random(2026)
    known = transactions = rebuilt = torn = 0
    for number in range(rounds):
        if number % 5 == 0:
            known = 0
            with open(image, "wb") as file:
                file.truncate(256 << 20)
            subprocess.run(["mkfs.ext4", "-q", "-F", image], check=True)
        subprocess.run(["mount", "-o", "loop", image, mount], check=True)
        store = os.path.join(mount, "store")
        writer = run(binary, "writer", STORE_WRITER=store)
        done = []
        listener = threading.Thread(target=listen, args=(writer, done), daemon=True)
        listener.start()
        time.sleep(dice.uniform(0.05, 1.5))
        disk = os.open(mount, os.O_RDONLY)
        # Only what was said before the power goes counts: a program that still runs afterwards, as no program
        # can, may be told by a dying file system that a sync has succeeded (seen on Linux 6.18).
        done = list(done)
        fcntl.ioctl(disk, SHUTDOWN, struct.pack("I", NO_LOG_FLUSH))
        os.close(disk)
        try:
            writer.wait(timeout=20)
        except subprocess.TimeoutExpired:
            writer.kill()
        listener.join()
        before, known = known, max([known, *done])
        transactions += max(0, known - before)
        subprocess.run(["umount", mount], check=True)
        subprocess.run(["mount", "-o", "loop", image, mount], check=True)
        if os.path.exists(store) or known:
            checker = run(binary, "checker", STORE_CHECK=store, STORE_KNOWN=str(known))
            said = checker.communicate()[0]
            rebuilt += "tables_rebuilt: Some" in said
            torn += "torn_bytes: 0" not in said
            if checker.returncode != 0:
                print(said)
                sys.exit(f"round {number}: FAILED, the disk is left mounted at {mount}")
            # sled's panics, which are caught, say where they are "at" as well.
            known = int(re.search(r"^at (\d+) of", said, re.MULTILINE)[1])
        subprocess.run(["umount", mount], check=True)
    shutil.rmtree(work)
    print(f"{rounds} power cuts, {transactions} acknowledged transactions, none lost;"
          f" tables built anew {rebuilt} times, torn tails {torn}")


if __name__ == "__main__":
    main()
