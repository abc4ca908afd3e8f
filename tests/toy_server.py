"""A service in its own process whose pictures are of one pixel: argv is data folder and port."""

import sys
from pathlib import Path

import uvicorn

from service.app import create_app
from service.server import Server, listening
from service.settings import Settings
from tests.toy_service import toy_executors
from worker.jobs.engine import EmbeddedEngine


def main() -> None:
    """Serve until told to stop."""
    settings = Settings()
    with toy_executors():
        engine = EmbeddedEngine(
            Path(sys.argv[1]), executor="toy_executor", measurer="toy_measurer", slots=1
        )
        app = create_app(settings, engine)
        config = uvicorn.Config(app, log_level="warning", timeout_graceful_shutdown=5)
        server = Server(config, app)
        listener = listening("127.0.0.1", int(sys.argv[2]))
        engine.start()
        server.run([listener])


if __name__ == "__main__":
    main()
