// The one instant of the lift that drawing and histories show together.

export class Clock {
  private listeners: ((time: number) => void)[] = [];
  constructor(public time: number, readonly start: number, readonly end: number) {}

  set(time: number): void {
    this.time = Math.min(Math.max(time, this.start), this.end);
    for (const listener of this.listeners) listener(this.time);
  }

  listen(listener: (time: number) => void): void { this.listeners.push(listener); }
}
