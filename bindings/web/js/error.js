// SPDX-License-Identifier: MIT
/** Names of statuses of the C interface, by their numbers. */
export const statusNames = [
  'ok', 'invalid argument', 'bad bound', 'needs refit', 'out of memory', 'stopped', 'internal error',
];

export class ShaftcullError extends Error {
  constructor(status, message, position) {
    super(message);
    this.name = 'ShaftcullError';
    this.status = status;
    this.position = position;
  }
}
