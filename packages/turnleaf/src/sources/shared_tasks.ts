interface Task<V> {
  readonly promise: Promise<V>;
  readonly controller: AbortController;
  waiting: number;
}

/** Runs one task per key for all its waiters, and aborts it when the last of them has given up. */
export class SharedTasks<K, V> {
  readonly #tasks = new Map<K, Task<V>>();

  /**
   * Returns the result of the key's task, started by `start` if none is
   * running. Rejects with the signal's reason when this waiter gives up.
   */
  async run(key: K, start: (signal: AbortSignal) => Promise<V>, signal?: AbortSignal): Promise<V> {
    signal?.throwIfAborted();
    const task = this.#tasks.get(key) ?? this.#start(key, start);
    task.waiting += 1;
    try {
      return await (signal ? orAborted(task.promise, signal) : task.promise);
    } finally {
      task.waiting -= 1;
      if (task.waiting === 0 && signal?.aborted) {
        this.#forget(key, task);
        task.controller.abort(signal.reason);
      }
    }
  }

  /** Aborts all tasks. Their waiters get `reason`, or an `AbortError` if there is none. */
  abortAll(reason?: Error): void {
    for (const [key, task] of [...this.#tasks]) {
      this.#forget(key, task);
      task.controller.abort(reason);
    }
  }

  #start(key: K, start: (signal: AbortSignal) => Promise<V>): Task<V> {
    const controller = new AbortController();
    const promise = start(controller.signal);
    const task: Task<V> = { promise, controller, waiting: 0 };
    this.#tasks.set(key, task);
    const done = (): void => this.#forget(key, task);
    promise.then(done, done);
    return task;
  }

  #forget(key: K, task: Task<V>): void {
    if (this.#tasks.get(key) === task) this.#tasks.delete(key);
  }
}

/** Resolves as `promise` does, or rejects with the signal's reason as soon as that aborts. */
export function orAborted<T>(promise: Promise<T>, signal: AbortSignal): Promise<T> {
  return new Promise((resolve, reject) => {
    const abort = (): void => reject(signal.reason);
    signal.addEventListener("abort", abort, { once: true });
    promise.then(resolve, reject).finally(() => signal.removeEventListener("abort", abort));
  });
}
