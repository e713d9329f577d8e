// The moment that the page shows: moved by the slider, the strips, the keyboard, by playing, and by a flight under way.

export class Clock {
  time_s = 0;
  end_s = 0;
  speed = 60;  // times real time
  isPlaying = false;
  isFollowing = false;  // the newest moment of a flight under way
  private last_ms = 0;
  private isAsked = false;
  private readonly listeners: (() => void)[] = [];

  /** Called once for each picture in which the moment, the end or the playing has changed. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  set(time_s: number): void {
    this.isFollowing = false;
    this.move(time_s);
  }

  extend(end_s: number): void {
    this.end_s = Math.max(end_s, 0);
    this.move(this.isFollowing ? this.end_s : this.time_s);
  }

  follow(isFollowing: boolean): void {
    this.isFollowing = isFollowing;
    if (isFollowing) {
      this.isPlaying = false;
      this.move(this.end_s);
    } else
      this.ask();
  }

  play(isPlaying: boolean): void {
    if (isPlaying && this.time_s >= this.end_s) this.time_s = 0;
    this.isPlaying = isPlaying;
    this.isFollowing = false;
    this.last_ms = performance.now();
    this.ask();
  }

  private move(time_s: number): void {
    this.time_s = Math.min(Math.max(time_s, 0), this.end_s);
    this.ask();
  }

  private ask(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame((now_ms) => this.tick(now_ms));
  }

  private tick(now_ms: number): void {
    this.isAsked = false;
    if (this.isPlaying) {
      this.time_s = Math.min(this.time_s + ((now_ms - this.last_ms) / 1000) * this.speed, this.end_s);
      this.last_ms = now_ms;
      this.isPlaying = this.time_s < this.end_s;
    }
    for (const listener of this.listeners) listener();
    if (this.isPlaying) this.ask();
  }
}
