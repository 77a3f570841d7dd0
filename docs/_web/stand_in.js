try {
  const { setItem } = Storage.prototype;
  localStorage.length;
  Storage.prototype.setItem = function (...pair) {
    try {
      setItem.apply(this, pair);
    } catch {}
  };
} catch {
  /** @type {{[key: string]: string}} */
  const kept = Object.create(null);
  /** @type {Pick<Storage, "getItem" | "setItem" | "removeItem"> & {isForgetful: true}} */
  const value = {
    isForgetful: true,
    getItem: (key) => kept[key] ?? null,
    setItem: (key, text) => {
      kept[key] = text;
    },
    removeItem: (key) => {
      delete kept[key];
    },
  };
  Object.defineProperty(window, "localStorage", { value });
}
