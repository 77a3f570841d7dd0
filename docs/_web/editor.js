// The editor, in a file of its own: it is loaded when a reader turns to the program.

import { closeBrackets, closeBracketsKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab, isolateHistory } from "@codemirror/commands";
import { python } from "@codemirror/lang-python";
import { bracketMatching, indentOnInput, indentUnit, syntaxHighlighting } from "@codemirror/language";
import { EditorState, StateEffect, StateField } from "@codemirror/state";
import { Decoration, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { classHighlighter } from "@lezer/highlight";

/** @type {import("@codemirror/state").StateEffectType<number>} */
const crashed = StateEffect.define();

// The line that stopped the program is marked until the text changes.
const mark = StateField.define({
  create: () => Decoration.none,
  update(marks, transaction) {
    for (const effect of transaction.effects) {
      if (effect.is(crashed)) {
        if (!effect.value || effect.value > transaction.state.doc.lines) return Decoration.none;
        const { from } = transaction.state.doc.line(effect.value);
        return Decoration.set(Decoration.line({ class: "run-crashed" }).range(from));
      }
    }
    return transaction.docChanged ? Decoration.none : marks;
  },
  provide: (field) => EditorView.decorations.from(field),
});

/** @param {Element} parent @param {string} text @param {number} caret in letters from the beginning
 *  @param {(text: string) => void} changed @param {() => void} run */
export function edit(parent, text, caret, changed, run) {
  const label = "Program: Escape, then Tab, leaves the editor";
  const view = new EditorView({
    parent,
    state: EditorState.create({
      doc: text,
      selection: { anchor: Math.min(caret, text.length) },
      extensions: [
        keymap.of([{ key: "Mod-Enter", run: () => (run(), true) }, indentWithTab, ...closeBracketsKeymap]),
        keymap.of([...defaultKeymap, ...historyKeymap]),
        [lineNumbers(), history(), indentOnInput(), bracketMatching(), closeBrackets(), highlightActiveLine()],
        [indentUnit.of("    "), python(), syntaxHighlighting(classHighlighter), mark],
        EditorView.contentAttributes.of({ tabindex: "0", "aria-label": label }),
        EditorView.updateListener.of((update) => update.docChanged && changed(update.state.doc.toString())),
      ],
    }),
  });
  return {
    focus: () => view.focus(),
    /** @param {string} text */
    replace: (text) =>
      view.dispatch({
        changes: { from: 0, to: view.state.doc.length, insert: text },
        annotations: isolateHistory.of("full"), // one press of Ctrl+Z brings the old text back, and no more
      }),
    /** Mark a line; 0 takes the mark away. @param {number} line */
    mark: (line) => view.dispatch({ effects: crashed.of(line) }),
  };
}
