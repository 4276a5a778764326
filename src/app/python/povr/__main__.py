"""The command line."""

import os
import signal
import sys
import sysconfig

from . import _povr


def _script():
    """The script `povr` that was installed with this module: that of this Python, or of the user."""
    folders = sysconfig.get_path("scripts"), sysconfig.get_path("scripts", f"{os.name}_user")
    paths = [os.path.join(folder, "povr.exe" if os.name == "nt" else "povr") for folder in folders]
    return next(filter(os.path.isfile, paths), None)


def main():
    """Runs ``povr``, or ``povray`` where it is called by that name, and ends the process."""
    # Ctrl-C is left to povr, unless the process ignores it.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    program = sys.argv[0]
    start = os.path.realpath(program)
    if os.path.basename(program) == "__main__.py":
        program, start = "povr", _script()
    code = _povr.run([program, *sys.argv[1:]], start, _povr.__file__)
    # The interpreter has nothing to tidy, and under `--sandbox` it may not.
    os._exit(code)


if __name__ == "__main__":
    main()
