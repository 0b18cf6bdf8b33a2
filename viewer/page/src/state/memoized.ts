// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** What is derived from a decoded message, once for each: messages are immutable, and views ask for it in each frame. */
export function memoized<Message extends object, T>(derive: (message: Message) => T): (message: Message) => T {
  const known = new WeakMap<Message, { value: T }>();
  return (message) => {
    let found = known.get(message);
    if (!found) known.set(message, (found = { value: derive(message) }));
    return found.value;
  };
}
