"""Starts of the program that cost no loading of two hundred libraries: see server.cc."""
import atexit
import functools
import os
import subprocess
import tempfile
import threading


class Server:
    """Of one program; starts with the first use. Where there is none, or one that is older than the program, the program itself is run."""

    def __init__(self, program):
        folder = os.path.join(os.path.dirname(program), 'tests')
        self.program, self.client, self.server = program, os.path.join(folder, 'signorini_client'), os.path.join(folder, 'signorini_server')
        self.process = self.place = None
        self.lock = threading.Lock()

    @property
    def usable(self):
        return (os.path.basename(self.program) == 'signorini' and 'SIGNORINI_UNSERVED' not in os.environ and os.path.exists(self.server)
                and os.path.exists(self.client) and os.path.getmtime(self.server) >= os.path.getmtime(self.program))

    def start(self, environment):
        """What stands for the program, and the variables it needs."""
        if not self.usable:
            return self.program, {}
        with self.lock:
            if not self.process:
                # Names of sockets have to be short.
                folder = tempfile.TemporaryDirectory(prefix='served-', dir='/tmp')
                self.place = os.path.join(folder.name, 'socket')
                self.process = subprocess.Popen([self.server, self.place], env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
                atexit.register(self.stop, folder)
                if self.process.stdout.readline() != b'listening\n':
                    raise SystemExit('the server of the program does not listen')
        return self.client, {'SIGNORINI_SERVER': self.place}

    def stop(self, folder):
        self.process.kill()
        self.process.wait()
        folder.cleanup()


@functools.lru_cache(maxsize=None)
def server_of(program):
    return Server(program)
