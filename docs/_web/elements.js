/** Make an element. Text is always text, never HTML.
 *  @template {keyof HTMLElementTagNameMap} T
 *  @param {T} tag
 *  @param {{[name: string]: any}} [properties] a name with a dash is an attribute
 *  @param {...(Node | string)} content
 *  @returns {HTMLElementTagNameMap[T]} */
export function make(tag, properties = {}, ...content) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === "role" || name.includes("-")) element.setAttribute(name, value);
    else Object.assign(element, { [name]: value });
  }
  element.append(...content);
  return element;
}

/** @param {string} text @param {() => void} onclick @param {string} [className] */
export function button(text, onclick, className = "") {
  return make("button", { type: "button", onclick, className }, text);
}
