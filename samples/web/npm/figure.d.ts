/** `<knurl-figure ridges amplitude stiffness speed rate methods>`; an `error` event tells why it cannot start. */
export class KnurlFigure extends HTMLElement {}

declare global {
  interface HTMLElementTagNameMap {
    "knurl-figure": KnurlFigure;
  }
}
