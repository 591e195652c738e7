"""A headless Chromium that is driven through its DevTools protocol over a pipe: nothing but Python is needed."""
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

PROGRAM = shutil.which('chromium')


class Browser:
    """Opens pages from the disk. `messages` are errors and warnings of the console and exceptions, `requests` what pages ask for."""

    def __init__(self, width=1280, height=900, webgl=True):
        self.folder = tempfile.mkdtemp()
        graphics = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] if webgl else ['--disable-3d-apis']
        options = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--disable-quic', '--no-first-run', '--disable-background-networking',
                   '--disable-component-update', '--disable-sync', '--hide-scrollbars', f'--window-size={width},{height}', '--remote-debugging-pipe',
                   f'--user-data-dir={self.folder}'] + graphics
        read_commands, self.commands = os.pipe()
        self.answers, write_answers = os.pipe()

        def place_pipes():
            # The browser reads from 3 and writes to 4; neither must be overwritten before it is copied.
            spare = [os.dup(read_commands), os.dup(write_answers)]
            while min(spare) < 5:
                spare = [os.dup(fd) for fd in spare]
            os.dup2(spare[0], 3)
            os.dup2(spare[1], 4)

        self.process = subprocess.Popen([PROGRAM] + options, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=place_pipes, close_fds=False)
        os.close(read_commands)
        os.close(write_answers)
        self.number = 0
        self.buffer = b''
        self.session = None
        self.messages, self.requests = [], []
        target = self.command('Target.createTarget', url='about:blank')['targetId']
        self.session = self.command('Target.attachToTarget', targetId=target, flatten=True)['sessionId']
        for domain in ('Page', 'Runtime', 'Network', 'Log'):
            self.command(domain + '.enable')

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.session = None
            self.command('Browser.close')
            self.process.wait(20)
        except (OSError, RuntimeError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.commands)
        os.close(self.answers)
        shutil.rmtree(self.folder, ignore_errors=True)

    def command(self, method, **parameters):
        self.number += 1
        message = {'id': self.number, 'method': method, 'params': parameters}
        if self.session:
            message['sessionId'] = self.session
        os.write(self.commands, json.dumps(message).encode() + b'\0')
        while True:
            answer = self.next_message()
            if answer.get('id') == self.number:
                if 'error' in answer:
                    raise RuntimeError(f'{method}: {answer["error"]}')
                return answer['result']

    def next_message(self):
        while b'\0' not in self.buffer:
            piece = os.read(self.answers, 1 << 20)
            if not piece:
                raise RuntimeError('the browser has gone')
            self.buffer += piece
        text, self.buffer = self.buffer.split(b'\0', 1)
        message = json.loads(text)
        self.take_event(message.get('method'), message.get('params', {}))
        return message

    def take_event(self, method, event):
        if method == 'Runtime.consoleAPICalled' and event['type'] in ('error', 'warning', 'assert'):
            self.messages.append(' '.join(str(a.get('value', a.get('description'))) for a in event['args']))
        elif method == 'Runtime.exceptionThrown':
            details = event['exceptionDetails']
            self.messages.append(details.get('exception', {}).get('description', details['text']))
        elif method == 'Log.entryAdded' and event['entry']['level'] in ('error', 'warning'):
            self.messages.append(event['entry']['text'])
        elif method == 'Network.requestWillBeSent':
            self.requests.append(event['request']['url'])

    def evaluate(self, script):
        """The value of an expression or of a promise."""
        result = self.command('Runtime.evaluate', expression=script, returnByValue=True, awaitPromise=True)
        if 'exceptionDetails' in result:
            raise RuntimeError(result['exceptionDetails'].get('exception', {}).get('description', 'exception'))
        return result['result'].get('value')

    def open(self, path, seconds=60):
        """Waits until the page is built and drawn."""
        self.messages, self.requests = [], []
        self.command('Page.navigate', url='file://' + os.path.abspath(path))
        end = time.time() + seconds
        while not self.evaluate('document.readyState === "complete" && document.documentElement.dataset.ready === "yes"'):
            if time.time() > end:
                raise RuntimeError(f'{path} is not ready: {self.messages}')
            time.sleep(.05)
        self.rest()

    def rest(self):
        """Until what was asked for is drawn."""
        self.evaluate('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 0))))')

    def drag(self, selector, dx, dy):
        """Moves the pointer with its button down, from the centre of an element on."""
        box = self.evaluate(f'(e => {{ e.scrollIntoView({{block: "center", behavior: "instant"}}); const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})(document.querySelector({json.dumps(selector)}))')
        x, y = box
        self.command('Input.dispatchMouseEvent', type='mousePressed', x=x, y=y, button='left', buttons=1, clickCount=1)
        for k in range(1, 6):
            self.command('Input.dispatchMouseEvent', type='mouseMoved', x=x + dx * k / 5, y=y + dy * k / 5, button='left', buttons=1)
        self.command('Input.dispatchMouseEvent', type='mouseReleased', x=x + dx, y=y + dy, button='left', clickCount=1)
        self.rest()

    def picture(self, path, width=1280, height=None):
        """A PNG of the whole page, or of so much of it."""
        height = height or self.evaluate('document.documentElement.scrollHeight')
        clip = {'x': 0, 'y': 0, 'width': width, 'height': height, 'scale': 1}
        data = self.command('Page.captureScreenshot', format='png', captureBeyondViewport=True, clip=clip)['data']
        with open(path, 'wb') as f:
            f.write(base64.b64decode(data))
