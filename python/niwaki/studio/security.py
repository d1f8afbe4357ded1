"""Access to the studio: only from this machine, with the printed token, from the studio's own page.

- The socket is bound to loopback. `Host` must name it with the studio's port, so a name that is rebound to 127.0.0.1 is
  refused.
- `Origin`, if present, must be the studio; `null` is refused. `Sec-Fetch-Site`, if present, must be `same-origin` or
  `none` (typed by the user): other pages cannot even load a picture from here. A browser's socket must have an origin.
- `/open?token=` works once and sets a cookie that scripts of the page cannot read. With this cookie a used link leads
  to the page, and the session's folder keeps it, so that an open page comes back after a restart. Browsers send
  cookies to every port of a host, so the cookie's name has the port and a random part: no other server on this machine
  knows it, and two studios do not overwrite each other's cookies.
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

#: Methods by path; all other paths accept GET and HEAD.
METHODS = {"/upload": ("POST",), "/mcp": ("DELETE", "GET", "POST")}


class Guard:
    """A check of every request in front of the application.

    Attributes
    ----------
    token : str
        The token that `/open` accepts next; a new token after each use.
    key : str
        The key that scripts send.
    cookie_name, cookie : str
        The cookie of known clients.
    """

    def __init__(self, app: ASGIApp, port: int, cookie: tuple[str, str] | None = None) -> None:
        self._app = app
        self._hosts = {f"{name}:{port}" for name in ("127.0.0.1", "localhost")}
        fresh = f"niwaki_{port}_{secrets.token_hex(4)}", secrets.token_urlsafe(32)
        self.cookie_name, self.cookie = cookie or fresh
        self.token = secrets.token_urlsafe(24)
        self.key = secrets.token_urlsafe(32)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or pass it on."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return

        async def guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers[name] = value
            await send(message)

        answer = self._rejection(scope)
        if answer is None and scope["type"] == "http" and scope["path"] == "/open":
            answer = self._redeem(scope)
        if answer is None and not self._is_known(Headers(scope=scope)):
            answer = PlainTextResponse("open the link that `niwaki studio` has printed\n", 403)
        if answer is None:
            await self._app(scope, receive, guarded)
        elif scope["type"] == "websocket":
            # The socket is not accepted yet, so the handshake is answered with 403.
            await send({"type": "websocket.close", "code": 1008})
        else:
            if answer.status_code >= 400:
                # A client without access does not keep its connection.
                answer.headers["Connection"] = "close"
            await answer(scope, receive, guarded)

    def _rejection(self, scope: Scope) -> Response | None:
        """Answer a request that no client may send; None for other requests."""
        headers = Headers(scope=scope)
        hosts = headers.getlist("host")
        if len(hosts) != 1 or hosts[0].lower() not in self._hosts:
            return PlainTextResponse("this is not the address of the studio\n", 421)
        origins = headers.getlist("origin")
        if origins and origins != [f"http://{hosts[0].lower()}"]:
            return PlainTextResponse("the request comes from another page\n", 403)
        site = headers.get("sec-fetch-site", "none")
        if site not in ("same-origin", "none"):
            return PlainTextResponse("the request comes from another page\n", 403)
        if scope["type"] == "websocket":
            is_script = "authorization" in headers
            return None if origins or is_script else PlainTextResponse("the socket has no origin\n", 403)
        allowed = METHODS.get(scope["path"], ("GET", "HEAD"))
        if scope["method"] not in allowed:
            return PlainTextResponse(
                "this path does not accept this method\n", 405, {"Allow": ", ".join(allowed)}
            )
        return None

    def _redeem(self, scope: Scope) -> Response:
        """Answer a token: with a cookie for its first use; then only a client with the cookie reaches the page."""
        query = scope["query_string"].decode("latin-1")
        token = query.removeprefix("token=") if query.startswith("token=") else ""
        if (
            scope["method"] == "GET"
            and not _equal(token, self.token)
            and self._is_known(Headers(scope=scope))
        ):
            return RedirectResponse("/", 303)
        if scope["method"] != "GET" or not _equal(token, self.token):
            return PlainTextResponse(
                "this link has been used or belongs to another studio; the terminal shows a new link\n", 403
            )
        self.token = secrets.token_urlsafe(24)
        answer = RedirectResponse("/", 303)
        answer.set_cookie(self.cookie_name, self.cookie, httponly=True, samesite="strict", path="/")
        return answer

    def _is_known(self, headers: Headers) -> bool:
        bearer = headers.get("authorization", "")
        if bearer:
            return _equal(bearer.removeprefix("Bearer "), self.key) and bearer.startswith("Bearer ")
        try:
            jar = SimpleCookie(headers.get("cookie", ""))
        except CookieError:
            return False
        return self.cookie_name in jar and _equal(jar[self.cookie_name].value, self.cookie)


def _equal(candidate: str, secret: str) -> bool:
    """Whether two secrets are equal; the time does not depend on where they differ."""
    return secrets.compare_digest(candidate.encode("utf-8", "replace"), secret.encode())
