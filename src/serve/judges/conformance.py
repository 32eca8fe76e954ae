"""The protocol's own conformance suite, put to a console: what of it asks for no tools of the suite's own. A pipe before
the console bears the token, which the suite does not know of. Usage: conformance.py ORTHO NODE SUITE"""

import socket
import subprocess
import sys
import threading

ORTHO, NODE, SUITE = sys.argv[1:4]
TOKEN = "a-token-of-sixteen-characters-or-more"
SCENARIOS = ["server-initialize", "ping", "tools-list", "server-sse-multiple-streams", "dns-rebinding-protection"]

console = subprocess.Popen(
    [ORTHO, "serve", "--demo", "--port", "0", "--pace", "20", "--token", TOKEN], stdout=subprocess.PIPE, text=True
)
port = int(console.stdout.readline().split("http://127.0.0.1:")[1].split("/")[0])


def pump(source, sink):
    try:
        while data := source.recv(65536):
            sink.sendall(data)
        sink.shutdown(socket.SHUT_WR)
    except OSError:
        pass


def bear(client, own):
    head = b""
    while b"\r\n\r\n" not in head:
        data = client.recv(65536)
        if not data:
            return client.close()
        head += data
    head, body = head.split(b"\r\n\r\n", 1)
    lines = [line for line in head.split(b"\r\n") if not line.lower().startswith(b"connection:")]
    lines = [line.replace(b":%d" % own, b":%d" % port) for line in lines]
    lines += [b"Authorization: Bearer " + TOKEN.encode(), b"Connection: close"]
    server = socket.create_connection(("127.0.0.1", port))
    server.sendall(b"\r\n".join(lines) + b"\r\n\r\n" + body)
    threading.Thread(target=pump, args=(client, server), daemon=True).start()
    pump(server, client)
    client.close()


def listen(listener):
    own = listener.getsockname()[1]
    while True:
        client, _ = listener.accept()
        threading.Thread(target=bear, args=(client, own), daemon=True).start()


listener = socket.create_server(("127.0.0.1", 0))
threading.Thread(target=listen, args=(listener,), daemon=True).start()
url = f"http://localhost:{listener.getsockname()[1]}/mcp"
failed = []
try:
    for scenario in SCENARIOS:
        done = subprocess.run(
            [NODE, SUITE, "server", "--url", url, "--scenario", scenario], capture_output=True, text=True, timeout=120
        )
        print(done.stdout[-3000:], done.stderr[-3000:])
        if done.returncode:
            failed.append(scenario)
finally:
    console.kill()
    console.wait()
if failed:
    sys.exit(f"failed: {failed}")
print("conforms")
