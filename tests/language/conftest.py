"""The plain run needs draws and densities: the engine's, or a stand-in where it is not built."""

import stub_engine

stub_engine.install()
