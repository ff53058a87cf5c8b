# OPC UA through asyncua: a server in a process of its own, and a client that writes values and reads values. A line with a
# number and a pace in seconds asks for so many calls; their times come back in nanoseconds, one line.
import asyncio, multiprocessing, socket, sys, time

NODES = int(sys.argv[1])


async def serve(ready):
    import logging
    from asyncua import Server
    logging.disable(logging.CRITICAL)
    server = Server()
    await server.init()
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    server.set_endpoint(f"opc.tcp://127.0.0.1:{port}/")
    space = await server.register_namespace("bench")
    variables = []
    for k in range(NODES):
        for name in ("enable", "ready"):
            node = await server.nodes.objects.add_variable(space, f"{name}{k}", False)
            await node.set_writable()
            variables.append(node.nodeid.to_string())
    async with server:
        ready.put((port, variables))
        await asyncio.sleep(3600)


async def call(port, variables):
    from asyncua import Client, ua
    async with Client(f"opc.tcp://127.0.0.1:{port}/") as client:
        nodes = [client.get_node(name) for name in variables]
        value = False
        print("ready", flush=True)
        for line in sys.stdin:
            count, pace = line.split()
            times, begun = [], time.perf_counter()
            for k in range(int(count)):
                wait = begun + k * float(pace) - time.perf_counter()
                if wait > 0:
                    time.sleep(wait)
                value = not value
                start = time.perf_counter_ns()
                await client.write_values(nodes[0::2], [ua.Variant(value, ua.VariantType.Boolean)] * NODES)
                await client.read_values(nodes[1::2])
                times.append(time.perf_counter_ns() - start)
            print(*times, flush=True)


if __name__ == "__main__":
    import asyncua  # what is not installed shows at once
    ready = multiprocessing.Queue()
    server = multiprocessing.Process(target=lambda: asyncio.run(serve(ready)), daemon=True)
    server.start()
    port, variables = ready.get(timeout=30)
    asyncio.run(call(port, variables))
