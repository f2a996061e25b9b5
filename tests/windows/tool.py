#!/usr/bin/python3
"""knurl.exe under wine beside this machine's own knurl: the same bytes, in a folder whose name is in no one code page.
usage: tool.py KNURL_EXE LIBRARIES KNURL ASSETS WINE_PREFIX [[CFGMGR32] EMULATE]
KNURL_EXE: beside it knurl_study.exe and the DLLs. LIBRARIES: a folder of those that drivers load.
With CFGMGR32 (cfgmgr32.c) and EMULATE (tests/device/rawhid/emulate_rawhid.c) only the raw HID driver is tried, on an emulated
device; with EMULATE alone only the Inverse3's, on an emulated service (tests/device/inverse3/emulate_inverse3.c), or the
serial one, on a pseudo terminal (tests/device/rawhid/emulate_serial.c). Nothing else may use the wine prefix meanwhile. Exit code 77: KNURL, or EMULATE, is missing.
SPDX-License-Identifier: MIT"""
import json
import math
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

EXE, LIBRARIES, NATIVE, ASSETS, PREFIX, *STAND_IN = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
ODD = "Größe-触"
FEEL = ["plate_1d", "grid_2d", "knurled_handle"]
ENVIRONMENT = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
ENVIRONMENT.update(WINEPREFIX=str(PREFIX), WINEDEBUG="-all", WINEDLLOVERRIDES="mscoree,mshtml,winedbg.exe=", LC_ALL="C.UTF-8")
INTERRUPTED = 130


class Run:
    """A program's output, by way of files: wine's own processes, which stay a while, would hold pipes open."""

    def __init__(self, folder, arguments):
        self.files = [tempfile.TemporaryFile(), tempfile.TemporaryFile()]
        self.process = subprocess.Popen([str(argument) for argument in arguments], cwd=folder, env=ENVIRONMENT,
                                        stdin=subprocess.DEVNULL, stdout=self.files[0], stderr=self.files[1])

    def end(self):
        self.code = self.process.wait(60)
        self.out, self.err = (self.read(file) for file in self.files)
        return self

    @staticmethod
    def read(file):
        file.seek(0)
        with file:
            return file.read()


class Home(unittest.TestCase):
    """A folder of the tool's own."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.home = pathlib.Path(cls.temporary.name) / ODD
        cls.home.mkdir()
        cls.exe = cls.home / "knurl.exe"
        for file in [*EXE.parent.glob("knurl*.exe"), *EXE.parent.glob("knurl*.dll"), *LIBRARIES.glob("*.dll")]:
            shutil.copy(file, cls.home)
        for name in FEEL:
            shutil.copy(ASSETS / f"{name}.glb", cls.home)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def read(self, name):
        return (self.home / name).read_bytes()


class Tool(Home):
    def windows(self, *arguments):
        return Run(self.home, ["wine", self.exe, *arguments]).end()

    def native(self, *arguments):
        return Run(self.home, [NATIVE, *arguments]).end()

    def refused(self, code, words, *arguments):
        """One line on standard error, nothing on standard output."""
        done = self.windows(*arguments)
        self.assertEqual((done.code, done.out, done.err.count(b"\n")), (code, b"", 1), done.err)
        self.assertTrue(done.err.startswith(b"knurl: ") and b"\r" not in done.err, done.err)
        self.assertIn(words, done.err.decode())

    def test_a_run_writes_the_same_bytes(self):
        for name in FEEL:
            arguments = ["run", f"{name}.glb", "--fast", "--seconds", "2", "--out"]
            there = self.windows(*arguments, "windows.csv")
            here = self.native(*arguments, "linux.csv")
            self.assertEqual((there.code, there.err), (here.code, here.err))
            self.assertEqual(self.read("windows.csv"), self.read("linux.csv"), name)
            there, here = json.loads(there.out), json.loads(here.out)
            for summary in there, here:  # the machine's times
                del summary["tick_ns"], summary["jitter_us"]
            self.assertTrue(math.isclose(there.pop("heat"), here.pop("heat"), rel_tol=1e-12))  # by each libm's own expm1()
            self.assertEqual(there, here)

    def test_other_commands_print_the_same_bytes(self):
        wave = ["--period-ms", "3.3", "--amplitude", "0.5", "--rate", "1000"]
        (self.home / "way.csv").write_text("x,y\r\n" + "".join(f"{i * 1e-4},0\r\n" for i in range(500)))
        for arguments in (["inspect", "grid_2d.glb"], ["signal", "--method", "T2", *wave, "--ticks", "999"],
                          ["--version"], ["run", "--help"],
                          ["scan", "--method", "bandlimited", "--fs", "1000,0", "--amplitude", "1", "--rate", "1000", "--in", "way.csv"],
                          ["run", "plate_1d.glb", "--fast", "--seconds", "1", "--out", "-"]):
            there, here = self.windows(*arguments), self.native(*arguments)
            self.assertEqual((there.code, there.out), (here.code, here.out), arguments)

    def test_metrics_are_the_same_but_for_the_rounding_of_the_spectrum(self):
        """Each compiler rounds the single-precision transform in its own way."""
        arguments = ["metrics", "--method", "T1", "--period-ms", "3.3", "--amplitude", "0.5", "--rate", "1000"]
        there, here = json.loads(self.windows(*arguments).out), json.loads(self.native(*arguments).out)
        for share in "false_tones", "felt_false_tones":
            self.assertTrue(math.isclose(there.pop(share), here.pop(share), rel_tol=1e-6), share)
        self.assertEqual(there, here)

    def test_paths_are_utf8(self):
        shutil.copy(self.home / "plate_1d.glb", self.home / f"{ODD}.glb")
        (self.home / f"{ODD}.trace.csv").write_text("t,x,y,z\n0,0,0.001,0\n1,0.01,-0.001,0\n")
        arguments = ["run", f"{ODD}.glb", "--trace", f"{ODD}.trace.csv", "--fast", "--out"]
        self.assertEqual(self.windows(*arguments, f"{ODD}.csv").code, self.native(*arguments, "linux.csv").code)
        self.assertEqual(self.read(f"{ODD}.csv"), self.read("linux.csv"))
        self.assertEqual(self.windows("study", "signals", "--out", f"{ODD}-study").code, 0)
        self.assertEqual(self.native("study", "signals", "--out", "linux-study").code, 0)
        self.assertEqual(self.read(f"{ODD}-study/signals.csv"), self.read("linux-study/signals.csv"))
        self.refused(1, f"{ODD}-none.glb: no such file", "inspect", f"{ODD}-none.glb")

    def test_what_is_wrong_is_said_in_one_line(self):
        self.refused(2, "expected a command", "fly")
        (self.home / "folder.glb").mkdir()
        self.refused(1, "expected a regular file, found a directory", "inspect", "folder.glb")
        self.refused(1, "found a directory", "scan", "--method", "S1", "--fs", "1,0", "--amplitude", "1", "--rate", "1000",
                     "--in", "folder.glb")
        self.refused(1, "built without libwebsockets, as all are for Windows", "run", "plate_1d.glb", "--view")
        self.refused(1, "No such file or directory", "run", "plate_1d.glb", "--fast", "--out", "none/felt.csv")

    def test_no_output_replaces_what_is_read(self):
        before = self.read("plate_1d.glb")
        self.refused(1, "it would be replaced", "run", "plate_1d.glb", "--fast", "--out", "PLATE_1D.GLB")
        self.assertEqual(self.read("plate_1d.glb"), before)

    def test_the_drivers_load_libusb_and_hidapi(self):
        reasons = {device["uri"]: device["unusable"] for device in json.loads(self.windows("devices", "--json").out)}
        self.assertIn("0403:cb48 is not among", reasons["falcon"])
        self.assertIn("not connected", reasons["rawhid"])
        self.assertEqual(reasons["fake"], "")

    def interrupted(self, arguments, parts):
        """Ctrl-C once there is a file that is not complete."""
        going = Run(self.home, ["wine", *arguments])
        deadline = time.monotonic() + 20
        while not list(self.home.glob(parts)) and time.monotonic() < deadline:
            time.sleep(0.05)
        time.sleep(0.2)
        going.process.send_signal(signal.SIGINT)  # wine makes Ctrl-C of it
        self.assertNotEqual(list(self.home.glob(parts)), [])
        return going.end()

    def test_ctrl_c_ends_a_study_and_takes_its_files_away(self):
        self.interrupted([self.home / "knurl_study.exe", "study", "tradeoff", "--out", "cut"], "cut/*.part")
        self.assertEqual(list(self.home.glob("cut/*")), [])

    def test_ctrl_c_ends_a_run_and_takes_its_file_away(self):
        done = self.interrupted([self.exe, "run", "plate_1d.glb", "--seconds", "40", "--out", "felt.csv"], "felt.csv.*.part")
        self.assertEqual(done.code, INTERRUPTED, done.err)
        self.assertIn(b"run: interrupted after", done.err)
        self.assertIn(b'"ticks"', done.out)
        self.assertEqual(list(self.home.glob("felt.csv*")), [])

    def test_the_bench_runs(self):
        done = self.windows("bench", "--json", "--case", "plane", "--ticks", "1000")
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual([case["case"] for case in json.loads(done.out)["cases"]], ["plane"])


class Emulated(Home):
    """wine's server starts its drivers, so it must start and end inside the device's environment."""

    def setUp(self):
        self.end_wine()
        shutil.copy(STAND_IN[0], self.home)

    def tearDown(self):
        self.end_wine()

    def end_wine(self):
        subprocess.run(["wineserver", "-k"], env=ENVIRONMENT, check=False)
        subprocess.run(["wineserver", "-w"], env=ENVIRONMENT, check=False, timeout=60)

    def test_a_plate_is_felt_with_a_raw_hid_device(self):
        ENVIRONMENT["WINEDLLOVERRIDES"] += ";cfgmgr32=n,b"
        felt = """
            for try in 1 2 3 4 5 6 7 8 9; do # wine's drivers start beside its first program
                wine knurl.exe devices --json >devices.json
                ! grep -q rawhid:16c0:0486 devices.json || break
                sleep 0.3
            done
            exec wine knurl.exe run plate_1d.glb --device rawhid --seconds 0.6"""
        for _ in range(4):  # on a busy machine the emulation stalls, and the device is lost
            done = Run(self.home, ["umockdev-wrapper", STAND_IN[1], "--", "sh", "-c", felt]).end()
            if done.code == 0:
                break
        self.assertEqual(done.code, 0, done.err)
        self.assertIn(b"rawhid:16c0:0486", self.read("devices.json"))
        summary = json.loads(done.out)
        self.assertGreater(summary["contact_s"], 0)
        self.assertGreater(summary["force_max_n"], 0.1)  # 400 N/m, a fraction of a millimetre deep


class Service(Home):
    """Haply's service on this machine's own loopback, which wine shares; knurl.exe reaches it by WinHTTP."""

    def felt(self, fault, seconds):
        return Run(self.home, [STAND_IN[0], fault, "wine", self.exe, "run", "plate_1d.glb", "--device",
                               "inverse3:049D?port=PORT", "--seconds", seconds]).end()

    def test_a_plate_is_felt_with_an_inverse3(self):
        for _ in range(4):  # on a busy machine the emulation stalls, and the device is lost
            done = self.felt("two", "1")
            if done.code == 0:
                break
        self.assertEqual(done.code, 0, done.err)
        summary = json.loads(done.out)
        self.assertIn("Haply Inverse3", summary["device"])
        self.assertGreater(summary["contact_s"], 0.1)
        self.assertGreater(summary["force_max_n"], 0.1)

    def test_faults_of_the_service_are_told(self):
        """After 0.1 s. A machine that is too busy to answer within 5 ms is silent, and asked again."""
        for fault, word in (("unplugged", b"lost"), ("unpowered", b"its power supply is unplugged"), ("closed", b"lost"),
                            ("mute", b"silent"), ("late", b"silent"), ("garbage", b"corrupt"), ("long", b"corrupt")):
            for _ in range(5):
                done = self.felt(fault, "0.6")
                if word in done.err + done.out:
                    break
            self.assertIn(word, done.err + done.out, fault)

    def test_a_service_that_is_absent_or_another_program_is_named(self):
        for fault, word in (("old", b"3.5 or newer"), ("strange", b"is not the Haply Inverse Service")):
            done = self.felt(fault, "1")
            self.assertEqual(done.code, 1)
            self.assertIn(word, done.err)
        done = Run(self.home, ["wine", self.exe, "run", "plate_1d.glb", "--device", "inverse3:?port=9"]).end()
        self.assertEqual(done.code, 1)
        self.assertIn(b"does not answer at localhost:9", done.err)

    def test_a_redirect_is_not_followed(self):
        """As test_inverse3_elsewhere.c has it for the other systems."""
        with socket.create_server(("127.0.0.1", 0)) as service, socket.create_server(("127.0.0.1", 0)) as elsewhere:
            elsewhere.settimeout(0.5)
            answer = f"HTTP/1.1 302 Found\r\nLocation: http://127.0.0.1:{elsewhere.getsockname()[1]}/\r\n" \
                "Content-Length: 0\r\n\r\n"

            def redirect():
                client, _ = service.accept()
                with client:
                    client.recv(4096)
                    client.sendall(answer.encode())
                    client.recv(4096)

            thread = threading.Thread(target=redirect, daemon=True)
            thread.start()
            done = Run(self.home, ["wine", self.exe, "run", "plate_1d.glb", "--device",
                                   f"inverse3:?port={service.getsockname()[1]}"]).end()
            thread.join(10)
            self.assertFalse(thread.is_alive())  # it was asked, and the client has left
            self.assertEqual(done.code, 1)
            self.assertRaises(TimeoutError, elsewhere.accept)


class Serial(Home):
    """A WoodenHaptics behind a pseudo terminal, which wine calls COM9. Wine lets any number of programs open it."""
    PORTS = r"HKLM\Software\Wine\Ports"
    TEENSY = r"HKLM\System\CurrentControlSet\Enum\USB\VID_16C0&PID_0483"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.port = cls.home / "port"
        cls.registry("add", cls.PORTS, "/v", "COM9", "/d", cls.port)
        cls.restart()  # wine reads its ports when it starts

    @classmethod
    def tearDownClass(cls):
        cls.registry("delete", cls.PORTS)
        cls.restart()
        super().tearDownClass()

    @classmethod
    def registry(cls, *arguments):
        done = Run(cls.home, ["wine", "reg", *arguments, "/f"]).end()
        if done.code != 0:
            raise AssertionError(done.out + done.err)

    @staticmethod
    def restart():
        for option in "-k", "-w":
            subprocess.run(["wineserver", option], env=ENVIRONMENT, check=False, timeout=60)

    def emulate(self):
        """Until the test ends, which ends `cat`, too."""
        self.port.unlink(missing_ok=True)
        device = subprocess.Popen([STAND_IN[0], self.port, "--", "cat"], stdin=subprocess.PIPE)
        self.addCleanup(lambda: (device.kill(), device.communicate()))
        while not self.port.is_symlink():
            time.sleep(0.01)
        return device

    def start(self, uri, seconds, *more):
        return Run(self.home, ["wine", self.exe, "run", "plate_1d.glb", "--device", uri, "--seconds", seconds, *more])

    def felt(self, uri):
        for _ in range(4):  # on a busy machine the emulation stalls, and the device is lost
            done = self.start(uri, 1).end()
            if done.code == 0:
                break
        self.assertEqual(done.code, 0, done.err)
        summary = json.loads(done.out)
        self.assertIn("WoodenHaptics", summary["device"])
        self.assertGreater(summary["contact_s"], 0.1)
        self.assertGreater(summary["force_max_n"], 0.1)  # 400 N/m, a fraction of a millimetre deep

    def refused(self, uri, words):
        done = self.start(uri, 0.1).end()
        self.assertEqual(done.code, 1)
        self.assertIn(words, done.err)

    def test_a_plate_is_felt_through_a_named_port(self):
        self.emulate()
        self.felt("serial:COM9")
        self.felt(r"serial:\\.\COM9")

    def test_the_port_of_a_teensy_is_found(self):
        self.refused("serial", b"16c0:0483) and found none; plug it in, or name its port as serial:COM3")
        for serial, name in ("100", "COM77"), ("200", "COM9"):  # the first was connected once
            self.registry("add", f"{self.TEENSY}\\{serial}\\Device Parameters", "/v", "PortName", "/d", name)
        self.addCleanup(self.registry, "delete", self.TEENSY)
        self.emulate()
        self.felt("serial")

    def test_a_port_that_cannot_be_opened_is_told_with_the_reason(self):
        self.refused("serial:COM77", b"COM77 could not be opened: there is no such port")
        self.refused(r"serial:C:\windows\win.ini", b"expected a serial port, such as COM3")

    def test_a_port_that_goes_away_is_a_lost_device(self):
        device = self.emulate()
        going = self.start("serial:COM9", 30, "--out", "felt.csv")
        while not list(self.home.glob("felt.csv.*.part")) and going.process.poll() is None:
            time.sleep(0.01)
        time.sleep(0.3)
        device.terminate()
        self.assertIn(b"lost", going.end().err)


if __name__ == "__main__":
    for needed in [NATIVE, *STAND_IN]:
        if not needed.exists():
            print(f"skipped: there is no {needed}")
            sys.exit(77)
    suites = {"emulate_inverse3": "Service", "emulate_serial": "Serial"}
    unittest.main(argv=[sys.argv[0], suites.get(STAND_IN[0].name, "Emulated") if STAND_IN else "Tool"])
