"""The command line."""

import os
import signal
import sys

from . import _povr


def main():
    """Runs ``povr``, or ``povray`` where it is called by that name, and ends the process."""
    # Ctrl-C is left to povr, unless the process ignores it.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    program = sys.argv[0]
    if os.path.basename(program) == "__main__.py":
        program = os.path.join(os.path.dirname(sys.executable), "povr")
    code = _povr.run([program, *sys.argv[1:]], os.path.realpath(program), _povr.__file__)
    # The interpreter has nothing to tidy, and under `--sandbox` it may not.
    os._exit(code)


if __name__ == "__main__":
    main()
