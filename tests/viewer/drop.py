"""Drops files on a window of an X server, as a file manager does: XDND, freedesktop.org, version 5."""

import ctypes
import sys
import time

CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31
PATIENCE = 90.0  # seconds


def drop(display_name, window, uris):
    """Drags `uris` over the window and lets them go; true once the window has taken them."""
    x11 = ctypes.CDLL("libX11.so.6")
    for name in ("XOpenDisplay", "XDefaultRootWindow", "XCreateSimpleWindow", "XInternAtom"):
        getattr(x11, name).restype = ctypes.c_void_p if name == "XOpenDisplay" else ctypes.c_ulong
    connection = ctypes.c_void_p(x11.XOpenDisplay(display_name.encode()))
    atom = lambda name: x11.XInternAtom(connection, name.encode(), 0)
    uri_list = atom("text/uri-list")
    source = x11.XCreateSimpleWindow(connection, ctypes.c_ulong(x11.XDefaultRootWindow(connection)),
                                     0, 0, 1, 1, 0, ctypes.c_ulong(0), ctypes.c_ulong(0))
    selection = atom("XdndSelection")
    x11.XSetSelectionOwner(connection, ctypes.c_ulong(selection), ctypes.c_ulong(source),
                           ctypes.c_ulong(0))

    def send(name, data):
        event = (ctypes.c_long * 24)()
        event[0] = CLIENT_MESSAGE
        event[4] = window
        event[5] = atom(name)
        event[6] = 32  # bits of each item
        for i, item in enumerate([source, *data]):
            event[7 + i] = item
        x11.XSendEvent(connection, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(event))
        x11.XFlush(connection)

    send("XdndEnter", [5 << 24, uri_list, 0, 0])
    send("XdndPosition", [0, (300 << 16) | 300, 0, atom("XdndActionCopy")])
    send("XdndDrop", [0, 0, 0, 0])

    # Send the list on request, and wait for the confirmation.
    text = "".join(uri + "\r\n" for uri in uris).encode()
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if not x11.XPending(connection):
            time.sleep(0.02)
            continue
        event = (ctypes.c_long * 24)()
        x11.XNextEvent(connection, ctypes.byref(event))
        kind = event[0] & 0x7F
        if kind == SELECTION_REQUEST:
            # owner, requestor, selection, target, property, time follow the display.
            requestor, target, where = event[5], event[7], event[8]
            x11.XChangeProperty(connection, ctypes.c_ulong(requestor), ctypes.c_ulong(where),
                                ctypes.c_ulong(target), 8, 0, text, len(text))
            answer = (ctypes.c_long * 24)()
            answer[0] = SELECTION_NOTIFY
            answer[4], answer[5], answer[6], answer[7] = requestor, selection, target, where
            x11.XSendEvent(connection, ctypes.c_ulong(requestor), 0, ctypes.c_long(0),
                           ctypes.byref(answer))
            x11.XFlush(connection)
        elif kind == CLIENT_MESSAGE and event[5] == atom("XdndFinished"):
            x11.XCloseDisplay(connection)
            return True
    x11.XCloseDisplay(connection)
    return False


if __name__ == "__main__":
    sys.exit(0 if drop(sys.argv[1], int(sys.argv[2]), sys.argv[3:]) else 1)
