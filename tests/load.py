#!/usr/bin/env python3
"""Asks a server for commands, very often, and watches what that leaves behind.

usage: tests/load.py CAROM [REQUESTS]

Starts `CAROM serve derivations` and sends REQUESTS (100000) over a few kept connections: grades, numbers, closed forms,
figures, descriptions, and requests that must be refused. Fails if an answer has another status than it should, or if memory,
threads, open files or children of the server grow between the first tenth and the end.
"""

import http.client
import json
import os
import pathlib
import subprocess
import sys
import threading
import time

STICK = "book/falling-stick.json"
SET = {"m": 1, "l": 1, "v": 2, "theta": "pi/6"}
# Address, body, status.
ASKED = [
    ("grade", {"expected": "3*v/(2*l)", "answer": "1.5 v/l"}, 200),
    ("grade", {"name": STICK, "quantity": "omega", "answer": "3v/(2l)"}, 200),
    ("solve", {"name": STICK, "set": SET}, 200),
    ("derive", {"name": "book/pool-balls.json"}, 200),
    ("draw", {"name": STICK, "which": "before", "set": SET}, 200),
    ("describe", {"name": STICK, "formulas": ["v/l"]}, 200),
    ("solve", {"name": STICK, "set": {"m": -1}}, 422),
    ("solve", {"name": "no-such-scene.json"}, 404),
]
CLIENTS = 4


def left_behind(server):
    """Resident memory in KiB, threads, open files, children."""
    process = pathlib.Path(f"/proc/{server.pid}")
    status = dict(line.split(":", 1) for line in (process / "status").read_text().splitlines())
    children = (process / f"task/{server.pid}/children").read_text().split()
    return [int(status["VmRSS"].split()[0]), int(status["Threads"]), len(os.listdir(process / "fd")), len(children)]


class Client(threading.Thread):
    """One kept connection; a server that is busy is asked again."""

    def __init__(self, address, numbers):
        super().__init__()
        self.address, self.numbers, self.done, self.wrong = address, numbers, 0, []

    def run(self):
        connection = http.client.HTTPConnection(self.address, timeout=120)
        for number in self.numbers:
            command, body, status = ASKED[number % len(ASKED)]
            try:
                connection.request("POST", f"/v1/{command}", json.dumps(body), {"Content-Type": "application/json"})
                answer = connection.getresponse()
                text = answer.read()
                if answer.status != status:
                    self.wrong.append(f"{command} {body}: {answer.status} {text[:200]!r}")
            except OSError as error:
                self.wrong.append(f"{command} {body}: {error!r}")
                connection.close()
            self.done += 1


def main():
    carom, requests = sys.argv[1], int((sys.argv[2:] or ["100000"])[0])
    server = subprocess.Popen([carom, "serve", "derivations", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        address = server.stdout.readline().strip().removeprefix("http://").rstrip("/")
        clients = [Client(address, range(k, requests, CLIENTS)) for k in range(CLIENTS)]
        begin = time.monotonic()
        for client in clients:
            client.start()
        seen = []
        while any(client.is_alive() for client in clients):
            time.sleep(0.5)
            done = sum(client.done for client in clients)
            if done >= requests * (len(seen) + 1) // 10:
                seen.append(left_behind(server))
                print(f"{done} requests in {time.monotonic() - begin:.0f} s: {seen[-1][0]} KiB, {seen[-1][1]} threads, {seen[-1][2]} files, {seen[-1][3]} children", flush=True)
        wrong = [line for client in clients for line in client.wrong]
        time.sleep(0.5)
        memory, threads, files, children = left_behind(server)
        first = seen[0]
        if memory > 1.5 * first[0]:
            wrong.append(f"memory grew from {first[0]} to {memory} KiB")
        if threads > first[1] or children > 0 or files > first[2]:
            wrong.append(f"left behind: {threads} threads, {files} files, {children} children")
    finally:
        server.terminate()
    ended = server.wait(10)
    if ended != 0:
        wrong.append(f"the server ended with {ended}")
    print("\n".join(wrong[:20]) or f"{requests} requests, each answered as it should be")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
