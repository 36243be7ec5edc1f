/**
 * Returns what loads the value of each key once, however often it is asked for. What failed is loaded again
 * when it is asked for again: it may be there then.
 */
export function loadedOnce<K, V>(load: (key: K) => Promise<V>): (key: K) => Promise<V> {
  const loaded = new Map<K, Promise<V>>();
  return (key) => {
    const known = loaded.get(key);
    if (known) return known;
    const loading = load(key);
    loaded.set(key, loading);
    loading.catch(() => loaded.delete(key));
    return loading;
  };
}
