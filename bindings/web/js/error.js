// SPDX-License-Identifier: MIT
export class ShaftcullError extends Error {
  constructor(status, message, position) {
    super(message);
    this.name = 'ShaftcullError';
    this.status = status;
    this.position = position;
  }
}
