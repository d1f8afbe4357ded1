"""Who may speak to the studio: this machine, by the token that was printed, from the studio's own page.

- The socket is bound to loopback. `Host` must name it with our port, so a name that is rebound to 127.0.0.1 is refused.
- `Origin`, where it is sent, must be ours; `null` is not. `Sec-Fetch-Site`, where it is sent, must be `same-origin`, or
  `none` (typed by the user): other pages cannot even load a picture from here. A browser's socket must have an origin.
- `/open?token=` serves once and sets a cookie that scripts of the page cannot read. Browsers send cookies to every port
  of a host, so the cookie's name has the port and a random part: no other server on this machine knows it, and
  two studios do not overwrite each other's.
- Scripts send the key as `Authorization: Bearer`.
"""

from __future__ import annotations

import secrets
from http.cookies import CookieError, SimpleCookie

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

#: Headers of every answer.
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
        "font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}

#: What each path takes; any other path takes GET.
METHODS = {"/upload": ("POST",)}


class Guard:
    """The application behind a check of every request.

    Attributes
    ----------
    token : str
        What `/open` takes next; another one after each use.
    key : str
        What scripts send.
    """

    def __init__(self, app: ASGIApp, port: int) -> None:
        self._app = app
        self._hosts = {f"{name}:{port}" for name in ("127.0.0.1", "localhost")}
        self._cookie_name = f"niwaki_{port}_{secrets.token_hex(4)}"
        self._cookie = secrets.token_urlsafe(32)
        self.token = secrets.token_urlsafe(24)
        self.key = secrets.token_urlsafe(32)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer, or pass a request on."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return

        async def guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers[name] = value
            await send(message)

        refused = self._refused(scope)
        if refused is None and scope["type"] == "http" and scope["path"] == "/open":
            refused = self._opened(scope)
        if refused is None and not self._is_known(Headers(scope=scope)):
            refused = PlainTextResponse("open the link that `niwaki studio` has printed\n", 403)
        if refused is None:
            await self._app(scope, receive, guarded)
        elif scope["type"] == "websocket":
            # Before it is accepted: the handshake is answered with 403.
            await send({"type": "websocket.close", "code": 1008})
        else:
            if refused.status_code >= 400:
                # Who is not known does not stay.
                refused.headers["Connection"] = "close"
            await refused(scope, receive, guarded)

    def _refused(self, scope: Scope) -> Response | None:
        """Why a request is refused, whoever sends it."""
        headers = Headers(scope=scope)
        hosts = headers.getlist("host")
        if len(hosts) != 1 or hosts[0].lower() not in self._hosts:
            return PlainTextResponse("this address is not the studio's\n", 421)
        origins = headers.getlist("origin")
        if origins and origins != [f"http://{hosts[0].lower()}"]:
            return PlainTextResponse("another page asked\n", 403)
        site = headers.get("sec-fetch-site", "none")
        if site not in ("same-origin", "none"):
            return PlainTextResponse("another page asked\n", 403)
        if scope["type"] == "websocket":
            is_script = "authorization" in headers
            return None if origins or is_script else PlainTextResponse("a socket without an origin\n", 403)
        allowed = METHODS.get(scope["path"], ("GET", "HEAD"))
        if scope["method"] not in allowed:
            return PlainTextResponse("not here\n", 405, {"Allow": ", ".join(allowed)})
        return None

    def _opened(self, scope: Scope) -> Response:
        """The answer to a token: once a cookie, then nothing."""
        query = scope["query_string"].decode("latin-1")
        given = query.removeprefix("token=") if query.startswith("token=") else ""
        if scope["method"] != "GET" or not _same(given, self.token):
            return PlainTextResponse(
                "this link was used, or is another one's; the terminal shows the next one\n", 403
            )
        self.token = secrets.token_urlsafe(24)
        answer = RedirectResponse("/", 303)
        answer.set_cookie(self._cookie_name, self._cookie, httponly=True, samesite="strict", path="/")
        return answer

    def _is_known(self, headers: Headers) -> bool:
        bearer = headers.get("authorization", "")
        if bearer:
            return _same(bearer.removeprefix("Bearer "), self.key) and bearer.startswith("Bearer ")
        try:
            jar = SimpleCookie(headers.get("cookie", ""))
        except CookieError:
            return False
        return self._cookie_name in jar and _same(jar[self._cookie_name].value, self._cookie)


def _same(given: str, known: str) -> bool:
    """Whether two secrets are the same, in a time that does not depend on where they differ."""
    return secrets.compare_digest(given.encode("utf-8", "replace"), known.encode())
