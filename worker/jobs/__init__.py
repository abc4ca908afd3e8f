"""The door to the worker: records of jobs, and the warm, killable children that do them.

Nothing here loads numpy, numba, OpenGL or an image library: the executor is a module *name* that
only a child imports. The service uses `worker.jobs.engine.EmbeddedEngine` and, from its main
thread, `worker.jobs.forkserver.start_forkserver`.
"""
