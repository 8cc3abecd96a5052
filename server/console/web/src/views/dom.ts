import { kNameMax, kNamePattern } from '../protocol/names';

/** Helpers that build the page. They set texts as text nodes only: nothing of the gateway becomes markup. */

type Child = Node | string | null;
type Attributes = Readonly<Record<string, string | number | boolean | ((event: Event) => void) | undefined>>;

/** Returns an element. Keys `on…` add listeners; `true` sets an empty attribute; `false` and undefined set none. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  setAttributes(node, attributes);
  node.append(...children.filter((child): child is Node | string => child !== null));
  return node;
}

/** Returns an SVG element. */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  setAttributes(node, attributes);
  node.append(...children.filter((child): child is Node | string => child !== null));
  return node;
}

function setAttributes(node: Element, attributes: Attributes): void {
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === 'function') node.addEventListener(key.slice(2), value);
    else if (value === true) node.setAttribute(key, '');
    else if (value !== false && value !== undefined) node.setAttribute(key, String(value));
  }
}

/** Sets a text only if it differs: writing the same text would disturb screen readers and selections. */
export function setText(node: Element, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}

export function setAttribute(node: Element, name: string, value: string | null): void {
  if (node.getAttribute(name) === value) return;
  if (value === null) node.removeAttribute(name);
  else node.setAttribute(name, value);
}

export function setDisabled(
  control: HTMLButtonElement | HTMLInputElement | HTMLSelectElement,
  disabled: boolean,
): void {
  if (control.disabled !== disabled) control.disabled = disabled;
}

/** Returns a label around its control. */
export function labelled(text: string, control: HTMLElement): HTMLLabelElement {
  return el('label', { class: 'field' }, el('span', {}, text), control);
}

/** Returns a field for a name. @param rule  words about names, which stand beside it */
export function nameField(rule: HTMLElement, attributes: Attributes = {}): HTMLInputElement {
  return el('input', {
    type: 'text',
    maxlength: kNameMax,
    pattern: kNamePattern,
    autocomplete: 'off',
    'aria-describedby': rule.id,
    ...attributes,
  });
}

/** Returns a select with options of value and text. */
export function select(
  options: readonly (readonly [string, string])[],
  chosen: string,
  onChange: (value: string) => void,
): HTMLSelectElement {
  const node = el('select', { onchange: () => onChange(node.value) });
  fillSelect(node, options, chosen);
  return node;
}

export function fillSelect(
  node: HTMLSelectElement,
  options: readonly (readonly [string, string])[],
  chosen: string,
): void {
  node.replaceChildren(...options.map(([value, text]) => el('option', { value }, text)));
  if (options.some(([value]) => value === chosen)) node.value = chosen;
}

export function button(text: string, onClick: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return el('button', { type: 'button', onclick: onClick, ...attributes }, text);
}

/** Returns a check box with its label. */
export function checkbox(text: string, checked: boolean, onChange: (checked: boolean) => void): HTMLLabelElement {
  const box = el('input', { type: 'checkbox', onchange: () => onChange(box.checked) });
  box.checked = checked;
  return el('label', { class: 'check' }, box, el('span', {}, text));
}

/** Returns a section with a heading. */
export function panel(title: string, className: string, ...children: Child[]): HTMLElement {
  const heading = el('h2', { id: `${className}-title` }, title);
  return el('section', { class: `panel ${className}`, 'aria-labelledby': heading.id }, heading, ...children);
}

/** Shows a dialog with a form. Resolves with the value of the field, or null when it was cancelled. */
export async function ask(
  title: string,
  explain: string,
  field: HTMLInputElement,
  fieldLabel: string,
  go: string,
  cancel: string,
): Promise<string | null> {
  return (await dialogOf(title, explain, labelled(fieldLabel, field), go, cancel)) ? field.value : null;
}

/** Shows a dialog that asks for a confirmation; the keyboard begins at the button that cancels. */
export function confirmOrder(title: string, explain: string, go: string, cancel: string): Promise<boolean> {
  return dialogOf(title, explain, null, go, cancel);
}

function dialogOf(
  title: string,
  explain: string,
  content: HTMLElement | null,
  go: string,
  cancel: string,
): Promise<boolean> {
  return new Promise((resolve) => {
    const confirm = el('button', { type: 'submit', value: 'go', class: 'danger' }, go);
    const heading = el('h2', { id: 'dialog-title' }, title);
    const dialog = el(
      'dialog',
      {
        'aria-labelledby': heading.id,
        onclose: () => {
          dialog.remove();
          resolve(dialog.returnValue === 'go');
        },
      },
      el(
        'form',
        { method: 'dialog' },
        heading,
        explain ? el('p', {}, explain) : null,
        content,
        el(
          'div',
          { class: 'row' },
          confirm,
          el('button', { type: 'submit', value: 'cancel', formnovalidate: true, autofocus: content === null }, cancel),
        ),
      ),
    );
    document.body.append(dialog);
    dialog.showModal();
  });
}
