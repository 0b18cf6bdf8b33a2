// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause

// Opens all details before the page is printed.
addEventListener('beforeprint', () => {
  for (const details of document.querySelectorAll('details')) details.open = true;
});

// Opens the details that contain the target of a link.
function reveal() {
  const target = location.hash && document.getElementById(location.hash.slice(1));
  for (let details = target && target.closest('details'); details;
       details = details.parentElement.closest('details')) {
    details.open = true;
  }
}
addEventListener('hashchange', reveal);
reveal();
