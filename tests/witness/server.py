"""An automation that is not ours: controls one pusher and one conveyor by the CPS-Protocol and checks what comes back.

Written from the protocol's text alone. Prints a log; exits 0 if all was as it should be, 1 if not.
"""

import argparse
import asyncio
import base64
import json
import sys
import time

from websockets.asyncio.server import serve

FLAGS = argparse.ArgumentParser(description=__doc__.splitlines()[0])
FLAGS.add_argument("--port", type=int, default=0, help="where to listen on 127.0.0.1; 0 for any free port")
FLAGS.add_argument("--pusher", default="Pusher", help="what the pusher's signals begin with")
FLAGS.add_argument("--belt", default="Belt", help="what the conveyor's signals begin with")
FLAGS.add_argument("--box", action="store_true", help="expect a box that passes the conveyor's light barriers")
FLAGS.add_argument("--timeout", type=float, default=10.0, help="seconds that each expectation may take")
START = time.monotonic()


def say(text):
    print(f"{time.monotonic() - START:7.3f} s  {text}", flush=True)


class Failed(Exception):
    pass


class Session:
    """One client: what it reported, in order, and what it refused."""

    def __init__(self, socket, flags):
        self.socket, self.flags = socket, flags
        self.values, self.news, self.id = {}, asyncio.Queue(), None

    async def read(self):
        """Reads until the connection ends; values and refusals go into the queue in their order."""
        async for text in self.socket:
            [(kind, body)] = json.loads(text).items()
            if kind == "Connect":
                await self.connect(body)
            elif kind == "SendValue":
                for entry in body:
                    await self.news.put((entry["name"], entry["value"]))
            elif kind == "SendValueReply":
                await self.news.put(("SendValueReply", {fault["name"]: fault["result"] for fault in body}))
            else:
                raise Failed(f"the client said {kind}")

    async def connect(self, body):
        base64.b64decode(body["Id"], validate=True)
        if self.id not in (None, body["Id"]):
            raise Failed(f"the client connected as {self.id} and now says it is {body['Id']}")
        self.id = body["Id"]
        name = base64.b64encode(b"witness").decode()
        reply = {"Id": body["Id"], "enable": body["enable"], "ServerName": name, "result": 200}
        await self.socket.send(json.dumps({"ConnectReply": reply}))
        await self.news.put(("Connect", body["enable"]))

    async def set(self, device, **commands):
        entries = [{"name": f"{device}.{signal}", "value": value} for signal, value in commands.items()]
        say("set  " + ", ".join(f"{entry['name']} = {entry['value']}" for entry in entries))
        await self.socket.send(json.dumps({"SendValue": entries}))

    async def expect(self, what, test):
        """Reads news until `test` holds of the present values."""
        try:
            async with asyncio.timeout(self.flags.timeout):
                while not test(self.values):
                    name, value = await self.news.get()
                    self.values[name] = value
        except TimeoutError:
            raise Failed(f"{what}: not within {self.flags.timeout} s; last values {self.values}") from None
        say(f"pass {what}")

    async def follow(self, device, *steps):
        """Expects a device's signals to take these values, one after the other."""
        for signal, wanted in steps:
            name = f"{device}.{signal}"
            await self.expect(f"{name} becomes {wanted}", lambda values: same(values.get(name), wanted))


def same(value, wanted):
    if value is None or isinstance(value, bool) or isinstance(wanted, bool):
        return value is wanted
    return abs(value - wanted) < 1e-3


async def control(s):
    pusher, belt = s.flags.pusher, s.flags.belt
    await s.expect("the client connects", lambda v: v.get("Connect") is True)
    names = [f"{pusher}.{signal}" for signal in ("limitExtended", "limitRetracted", "isRunning")] + [
        f"{belt}.{signal}" for signal in ("velocityActual", "driveEnabled", "driveRunning", "directionalActual")]
    await s.expect("all present outputs follow the 200", lambda v: all(name in v for name in names))
    await s.follow(pusher, ("limitRetracted", True), ("limitExtended", False))
    await s.follow(belt, ("velocityActual", 0.0), ("driveEnabled", False))

    await s.set(pusher, command=1)
    await s.follow(pusher, ("isRunning", True), ("limitRetracted", False), ("limitExtended", True), ("isRunning", False))
    await s.set(pusher, command=2)
    await s.follow(pusher, ("isRunning", True), ("limitExtended", False), ("limitRetracted", True), ("isRunning", False))

    await s.set(belt, velocityTarget=0.5, motorDirection=1)
    await s.follow(belt, ("driveEnabled", True), ("driveRunning", True), ("directionalActual", 1), ("velocityActual", 0.5))
    if s.flags.box:
        await s.follow(belt, *((f"lightBarrier{x}", cut) for x in "AB" for cut in (True, False)))
    await s.set(belt, motorDirection=-1)
    await s.follow(belt, ("directionalActual", 0), ("directionalActual", -1), ("velocityActual", -0.5))
    await s.set(belt, motorDirection=0)
    await s.follow(belt, ("driveEnabled", False), ("driveRunning", False), ("velocityActual", 0.0))

    # Out of its range, of another type, unknown, and not the automation's to set: one reply for all.
    await s.set(belt, motorDirection=5, velocityTarget="fast", colour=1, velocityActual=1.0)
    wanted = {f"{belt}.motorDirection": 422, f"{belt}.velocityTarget": 415, f"{belt}.colour": 404,
              f"{belt}.velocityActual": 404}
    await s.expect("all four faults come back in one reply", lambda v: v.get("SendValueReply") == wanted)
    say("all checks passed")
    await s.expect("the client disconnects", lambda v: v.get("Connect") is False)


async def main(flags):
    verdict = asyncio.get_running_loop().create_future()

    async def serve_client(socket):
        session = Session(socket, flags)
        reader, controller = asyncio.create_task(session.read()), asyncio.create_task(control(session))
        done, _ = await asyncio.wait({reader, controller}, return_when=asyncio.FIRST_COMPLETED)
        if reader in done and not reader.exception():
            # The last message may still be in the queue.
            await asyncio.wait({controller}, timeout=1)
        error = next((t.exception() for t in (reader, controller) if t.done() and t.exception()), None)
        if not error and not controller.done():
            error = Failed("the client closed the connection amid the checks")
        if not verdict.done():
            verdict.set_result(error)

    async with serve(serve_client, "127.0.0.1", flags.port) as server:
        say(f"listening on ws://127.0.0.1:{server.sockets[0].getsockname()[1]}")
        error = await verdict
    if error:
        say(f"FAIL {type(error).__name__}: {error}")
    return 1 if error else 0


if __name__ == "__main__":
    sys.exit(asyncio.run(main(FLAGS.parse_args())))
