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
  { pixels: 0.8, shadows: false },
  { pixels: 0.66, shadows: false },
];

const kSlow_s = 1 / 40;
const kSlowBySoftware_s = 1 / 21;
const kQuick_s = 1 / 55;
const kMostBySoftware = 30;  // pictures a second
const kJudge_s = 1.2;
const kRise_s = 20;

export class Pacer {
  private level: number;
  private usual_s = 1 / 30;
  private judged_s = 0;
  private due_s = 0;
  private rose_s = 0;
  private risen = 0;

  /** `held`: at its best, whatever it takes: for pictures of the page. */
  constructor(private readonly software: boolean, private readonly held: boolean) {
    this.level = software && !held ? 2 : 0;
  }

  get quality(): Quality {
    return kLevels[this.level]!;
  }

  /** Whether a picture is wanted at this call of the browser. */
  is_due(now_s: number): boolean {
    if (!this.software) return true;
    const step_s = 1 / kMostBySoftware;
    if (now_s < this.due_s - 0.25 * step_s) return false;
    this.due_s = Math.max(this.due_s + step_s, now_s - step_s);
    return true;
  }

  get frames_per_second(): number {
    return 1 / this.usual_s;
  }

  /** After a frame was drawn; whether the quality changed. */
  drew(interval_s: number, now_s: number): boolean {
    if (interval_s > 0.5) return false;  // the tab was hidden
    this.usual_s += (interval_s - this.usual_s) * 0.06;
    if (this.held || now_s - this.judged_s < kJudge_s) return false;
    this.judged_s = now_s;
    if (this.usual_s > (this.software ? kSlowBySoftware_s : kSlow_s) && this.level + 1 < kLevels.length) {
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
