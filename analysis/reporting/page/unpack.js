"use strict";

// Numbers as analysis/reporting/packed.cpp writes them.

function bytesOf(base64) {
  const raw = atob(base64);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}

function unpackFloats(base64) {
  return new Float32Array(bytesOf(base64).buffer);
}

/** Levels between the least and the greatest number; NaN where there is none. */
function unpackLevels({offset, scale, data}) {
  const missing = 65535;
  return Float32Array.from(new Uint16Array(bytesOf(data).buffer),
                           level => level === missing ? NaN : offset + scale * level);
}

/** Rows of numbers (as many as `first`), each with its differences in `unit`; NaN from where a row
    ends early. */
function unpackSteps({unit, first, data}) {
  const ended = -32768;
  const steps = new Int16Array(bytesOf(data).buffer);
  const numbers = new Float32Array(steps.length);
  const length = steps.length / first.length;
  first.forEach((start, row) => {
    let count = 0;
    let over = start === null;
    for (let k = row * length; k < (row + 1) * length; ++k) {
      over = over || steps[k] === ended;
      count += over ? 0 : steps[k];
      numbers[k] = over ? NaN : start + unit * count;
    }
  });
  return numbers;
}
