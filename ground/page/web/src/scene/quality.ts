// Gives up beauty before speed: fewer pixels, then shadows, when frames take too long. Pure.
//
// A browser without a graphics card draws with the processor, and on one machine with a swarm the processor is the
// swarm's: there the picture is drawn thirty times a second at most.

export interface Quality {
  pixels: number;   // of the screen's own density
  shadows: boolean;
}

const kLevels: readonly Quality[] = [
  { pixels: 2, shadows: true },
  { pixels: 1.5, shadows: true },
  { pixels: 1, shadows: true },
  { pixels: 1, shadows: false },
  { pixels: 0.75, shadows: false },
  { pixels: 0.5, shadows: false },
];

const kSlow_s = 1 / 24;
const kQuick_s = 1 / 50;
const kJudge_s = 1.2;
const kRise_s = 20;

export class Pacer {
  private level: number;
  private usual_s = 1 / 40;
  private judged_s = 0;
  private rose_s = 0;
  private risen = 0;

  constructor(private readonly software: boolean) {
    this.level = software ? 2 : 0;
  }

  get quality(): Quality {
    return kLevels[this.level]!;
  }

  get least_interval_s(): number {
    return this.software ? 1 / 31 : 0;
  }

  get frames_per_second(): number {
    return 1 / this.usual_s;
  }

  /** After a frame was drawn; whether the quality changed. */
  drew(interval_s: number, now_s: number): boolean {
    if (interval_s > 0.5) return false;  // the tab was hidden
    this.usual_s += (interval_s - this.usual_s) * 0.06;
    if (now_s - this.judged_s < kJudge_s) return false;
    this.judged_s = now_s;
    if (this.usual_s > kSlow_s && this.level + 1 < kLevels.length) {
      ++this.level;
      this.rose_s = now_s;
      return true;
    }
    // A way back, twice at most: a machine at the edge would go up and down for ever.
    if (!this.software && this.usual_s < kQuick_s && this.level > 0 && this.risen < 2 && now_s - this.rose_s > kRise_s) {
      --this.level;
      ++this.risen;
      this.rose_s = now_s;
      return true;
    }
    return false;
  }
}

/** Whether the name of a renderer is that of one without a graphics card. */
export function draws_by_processor(renderer: string): boolean {
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
}
