"""Access to the studio: each known attack is tried on a real server."""

from __future__ import annotations

import http.client
import json
import socket
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("starlette")

from niwaki import studio
from niwaki.studio import server, serving
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect as dial


def ask(served, method="GET", path="/", body=None, **headers):
    """Send a request; names of headers have `_` for `-`."""
    link = http.client.HTTPConnection("127.0.0.1", served.port, timeout=60)
    link.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
    answer = link.getresponse()
    data = answer.read()
    link.close()
    return answer.status, dict(answer.getheaders()), data


def key(served):
    return {"Authorization": f"Bearer {served.key}"}


@pytest.fixture(scope="module")
def cookie(served) -> Iterator[str]:
    """The cookie of the first link; the link then stops working."""
    status, headers, _ = ask(served, path=f"/open?token={served.token}")
    assert status == 303 and headers["location"] == "/"
    parts = headers["set-cookie"].split("; ")
    assert "HttpOnly" in parts and "SameSite=strict" in parts
    yield parts[0]


def test_the_cookie_opens_the_page_and_its_name_is_this_studios_own(served, cookie):
    name, _, value = cookie.partition("=")
    assert name.startswith(f"niwaki_{served.port}_") and len(name.rpartition("_")[2]) == 8
    assert ask(served, Cookie=cookie)[0] == 200
    assert ask(served, Cookie=f"{name}=x{value[1:]}x")[0] == 403
    assert ask(served, Cookie=f"niwaki_{served.port}_00000000={value}")[0] == 403


def test_a_used_link_leads_only_a_known_browser_to_the_page(served, cookie):
    status, headers, _ = ask(served, path="/open?token=used", Cookie=cookie)
    assert (status, headers["location"]) == (303, "/") and "set-cookie" not in headers
    assert ask(served, path="/open?token=used", Cookie=f"{cookie}x")[0] == 403
    assert ask(served, path="/open?token=used")[0] == 403


def test_the_token_serves_once_and_another_one_is_printed(served, cookie):
    assert ask(served, path=f"/open?token={served.token}")[0] == 403
    fresh = served.next_token()
    assert ask(served, path=f"/open?token={fresh}x")[0] == 403
    assert ask(served, path=f"/open?token={fresh}", Sec_Fetch_Site="none")[0] == 303
    assert ask(served, path=f"/open?token={fresh}")[0] == 403


@pytest.mark.parametrize("path", ["/", "/app.js", "/file/" + "0" * 64, "/socket", "/anything"])
def test_requests_without_cookie_or_key_are_refused(served, path):
    assert ask(served, path=path)[0] == 403
    assert ask(served, path=path, Authorization="Bearer wrong")[0] == 403
    assert ask(served, path=path, Authorization=f"Basic {served.key}")[0] == 403


@pytest.mark.parametrize(
    "host", ["evil.example", "127.0.0.1", "localhost:1", "evil.example:{port}", "127.0.0.1.evil:{port}", ""]
)
def test_a_name_that_is_bound_to_this_machine_later_is_refused(served, host):
    status, _, data = ask(served, Host=host.format(port=served.port), **key(served))
    assert status in (400, 421) and b"<html" not in data


def test_both_names_of_loopback_are_accepted(served):
    for host in ("127.0.0.1", "localhost"):
        assert ask(served, Host=f"{host}:{served.port}", **key(served))[0] == 200


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "https://127.0.0.1:{port}", "http://127.0.0.1:1"]
)
def test_another_origin_is_refused(served, cookie, origin):
    assert ask(served, Origin=origin.format(port=served.port), Cookie=cookie)[0] == 403


@pytest.mark.parametrize("site", ["cross-site", "same-site", "nonsense"])
def test_a_request_that_another_page_starts_is_refused(served, cookie, site):
    assert ask(served, Sec_Fetch_Site=site, Cookie=cookie)[0] == 403
    assert ask(served, Sec_Fetch_Site="same-origin", Cookie=cookie)[0] == 200


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH"])
def test_other_methods_are_refused(served, method):
    assert ask(served, method, **key(served))[0] == 405
    assert ask(served, "GET", "/upload", **key(served))[0] == 405


def test_every_answer_has_the_headers_that_keep_pages_apart(served):
    for path, status in (("/", 200), ("/nothing", 404)):
        answer, headers, _ = ask(served, path=path, **key(served))
        assert answer == status
        policy = headers["content-security-policy"]
        assert (
            "default-src 'none'" in policy and "frame-ancestors 'none'" in policy and "unsafe" not in policy
        )
        assert headers["x-content-type-options"] == "nosniff" and headers["referrer-policy"] == "no-referrer"


@pytest.mark.parametrize(
    "path",
    ["/../../../etc/passwd", "/%2e%2e/%2e%2e/session.json", "/file/..%2f..%2fsession.json", "/file/../session.json",
     "/file/" + "g" * 64, "/app.js/../../messages.py", "/page/index.html"],
)  # fmt: skip
def test_no_path_leads_out(served, path):
    status, _, data = ask(served, path=path, **key(served))
    assert status == 404 and b"session" not in data


def test_a_socket_needs_the_origin_of_the_page_or_the_key(served, cookie):
    url = f"ws://127.0.0.1:{served.port}/socket"
    for headers in (
        {},
        {"Cookie": cookie},
        {"Cookie": cookie, "Origin": "http://evil.example"},
        {"Origin": served.url},
    ):
        with pytest.raises(InvalidStatus) as caught, dial(url, additional_headers=headers, proxy=None):
            pass
        assert caught.value.response.status_code == 403
    with dial(url, additional_headers={"Cookie": cookie, "Origin": served.url}, proxy=None) as link:
        link.send('{"kind": "hello", "protocol": 1}')
        assert '"state"' in link.recv(10)


INVALID = (
    "",
    "{",
    "[]",
    "[" * 5000,
    '{"kind": "nothing"}',
    '{"kind": "run", "more": 1}',
    '{"kind": "pick", "key": {"run": -1}}',
    '{"kind": "hello", "protocol": 99}',
    '{"kind": "ask", "ask": {"target": {"source": "/etc/passwd"}}}',
    '{"kind": "model", "reference": "/etc/passwd.py:x"}',
    '{"kind": "export", "key": {"run": 0}, "format": "exe"}',
)


def test_invalid_messages_are_refused_and_the_socket_stays(served):
    with studio.connect(served.url, served.key) as script:
        for text in INVALID:
            script._socket.send(text)
            event = script.read(5)
            while event["kind"] != "error":
                event = script.read(5)
        assert script.ask("undo")["kind"] == "done"


def test_a_message_that_is_too_long_ends_its_socket_only(served):
    with studio.connect(served.url, served.key) as script:
        script._socket.send("x" * (server.COMMAND + 1))
        with pytest.raises(Exception, match="1009|too big|too long|close"):
            for _ in range(10):
                script.read(5)
    assert ask(served, **key(served))[0] == 200


def test_a_mesh_that_is_too_large_is_refused_before_it_is_read(served):
    link = socket.create_connection(("127.0.0.1", served.port), 10)
    access = f"Host: 127.0.0.1:{served.port}\r\nAuthorization: Bearer {served.key}\r\n"
    head = f"POST /upload?name=a.stl HTTP/1.1\r\n{access}"
    link.sendall(f"{head}Content-Length: {server.UPLOAD + 1}\r\n\r\n".encode())
    assert b" 413 " in link.recv(200)
    link.close()
    # Without a declared length, the bytes are counted on arrival.
    link = socket.create_connection(("127.0.0.1", served.port), 10)
    link.sendall(f"{head}Transfer-Encoding: chunked\r\n\r\n".encode())
    chunk = b"100000\r\n" + bytes(1 << 20) + b"\r\n"
    try:
        for _ in range((server.UPLOAD >> 20) + 2):
            link.sendall(chunk)
    except OSError:
        pass
    assert b" 413 " in link.recv(200)
    link.close()


@pytest.mark.parametrize(
    "name,body", [("a.exe", b"x"), ("a.stl", b"not a mesh"), ("a.obj", b""), ("a.glb", b"glTF" + bytes(40))]
)
def test_an_invalid_mesh_is_refused_with_a_reason(served, name, body):
    status, _, data = ask(served, "POST", f"/upload?name={name}", body, **key(served))
    assert status in (415, 422) and json.loads(data)["text"]


def test_a_mesh_that_needs_too_much_memory_ends_its_own_process_only(served):
    # A binary STL that declares many triangles and has few; an OBJ of one huge polygon.
    stl = bytes(80) + (2**32 - 1).to_bytes(4, "little") + bytes(50)
    status, _, data = ask(served, "POST", "/upload?name=bomb.stl", stl, **key(served))
    assert status == 422 and json.loads(data)["text"]
    assert ask(served, **key(served))[0] == 200


def test_the_studio_answers_while_a_thousand_others_say_nothing(served):
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    count = min(1000, hard - 100)
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, min(hard, count + 200)), hard))
    silent = []
    try:
        for k in range(count):
            link = socket.create_connection(("127.0.0.1", served.port), 5)
            if k % 2:
                link.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.")
            silent.append(link)
        # The oldest connections are closed; the others do not block a new connection.
        assert ask(served, **key(served))[0] == 200
        end = time.monotonic() + 60.0
        while sum(map(_is_closed, silent)) < count - serving.CONNECTIONS:
            assert time.monotonic() < end
            time.sleep(0.02)
        assert ask(served, **key(served))[0] == 200
    finally:
        for link in silent:
            link.close()
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


def _is_closed(link: socket.socket) -> bool:
    link.setblocking(False)
    try:
        return link.recv(1) == b""
    except BlockingIOError:
        return False
    except OSError:
        return True


def test_it_listens_on_loopback_only(served):
    place = Path("/proc/net/tcp")
    if not place.is_file():
        pytest.skip("no list of sockets")
    rows = [line.split()[1] for line in place.read_text().splitlines()[1:] if line.split()[3] == "0A"]
    assert f"0100007F:{served.port:04X}" in rows and f"00000000:{served.port:04X}" not in rows


def test_the_key_is_for_the_user_only(served):
    assert (served.folder / "key").stat().st_mode & 0o077 == 0


def test_nothing_stored_is_a_pickle(served):
    for place in served.folder.rglob("*"):
        if place.is_file():
            assert not place.read_bytes().startswith(b"\x80"), place
