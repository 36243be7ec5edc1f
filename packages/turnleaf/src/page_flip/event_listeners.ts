/** Listeners by the name of their event, as page-flip has them. */

/** What a listener gets. */
export interface WidgetEvent<Data, Source> {
  /** What has happened; its type is the event's. */
  readonly data: Data;
  /** The book that it happened to. */
  readonly object: Source;
}

/** Keeps listeners and calls them. */
export class EventListeners<Events extends object, Source> {
  private readonly listeners = new Map<keyof Events, ((event: never) => void)[]>();

  /** Adds a listener. */
  add<K extends keyof Events>(
    name: K,
    listener: (event: WidgetEvent<Events[K], Source>) => void,
  ): void {
    this.listeners.set(name, [...(this.listeners.get(name) ?? []), listener]);
  }

  /** Removes one listener of an event, or all if none is given. */
  remove(name: keyof Events, listener?: (event: never) => void): void {
    const left = this.listeners.get(name)?.filter((other) => listener && other !== listener);
    this.listeners.set(name, left ?? []);
  }

  /** Calls the listeners of an event. One that removes another meanwhile does not stop that. */
  call<K extends keyof Events>(name: K, data: Events[K], object: Source): void {
    const event = { data, object };
    for (const listener of this.listeners.get(name) ?? []) {
      (listener as (event: WidgetEvent<Events[K], Source>) => void)(event);
    }
  }
}
