/* Gyre's protocol without its mechanics: terms, wish, agreement, lease; two agents, a coordinator that dies and comes
 * back, a network that loses and delays. README.md says what is claimed, and what is left out. Each inline names the
 * function in the code that it follows, and is to be read beside it.
 *
 * Everything happens in rounds. In each: a person, or death; the coordinator's tick; the beacon, to each agent lost,
 * delivered or delayed; each agent's answer, likewise; then time passes, by the same amount as the lease's patience.
 *
 * Macros that break it on purpose, to see that the claims can fail: BREAK_*. Macros that ask for more than is true, and
 * show how far the promise goes: CLAIM_*. */

#ifndef LIVES
#define LIVES 2 /* coordinators, one after the other */
#endif
#ifndef COMMANDS
#define COMMANDS 1 /* of a person, that are obeyed */
#endif
#ifndef CHANGES
#define CHANGES 3 /* proposals; so many are tried at most */
#endif
#ifndef OLDEST
#define OLDEST 1 /* AgentOptions::beacon_age_max: for so many more rounds a dead coordinator's last word is believed */
#endif
#ifndef LEASE
#define LEASE (PATIENCE + OLDEST + 2) /* silence.stop_after_s, in rounds */
#endif
#ifndef DELAYS
#define DELAYS 1 /* links that delay what they carry, of the two; all of them lose it */
#endif
#ifndef PATIENCE
#define PATIENCE 1 /* LeaseBook::kPatience */
#endif
#ifndef SPARE
#define SPARE OLDEST /* so much earlier a step is made than it could be taken back at all */
#endif
#define TIMEOUT PATIENCE /* CoordinatorOptions::agent_timeout */
#define LEAD 2     /* AgreementOptions::lead */
#define MARGIN 1   /* AgreementOptions::go_margin */
#define CHECK 1    /* CoordinatorOptions::start_check */

#ifndef ONLY
#define ONLY 0 /* this claim; 0: all */
#endif
#define CLAIM(number, holds) assert((ONLY != 0 && ONLY != number) || (holds))

#ifndef REACH
#define REACH PATIENCE /* LeaseBook::kReach */
#endif
#ifndef APART
#define APART REACH /* the stops of two agents, at most */
#endif

/* A moment is told as how far ahead it is: 0: none; 1: it is over; 2 + n: n rounds ahead. */
#define OVER 1
#define NEXT (LEASE + 2)
#define IS_OVER(lease) ((lease) == OVER)

#define NOBODY 0
#define START 1
#define PERSON 2
#define SILENCE 3

/* rev 0: none. Instead of a pace axis: where it leads. A change counts as soon as it is heard. */
typedef Course {
  byte term;
  unsigned rev : 4;
  bit wish;         /* pace wished: 0 rest, 1 full motion */
  unsigned by : 2;  /* whose wish */
  bit target;       /* pace flown */
  unsigned lease : 4;
  bit newest        /* of all leases that were granted; no two are the same to the nanosecond */
}
typedef Proposal { unsigned rev : 4; bit wish; unsigned by : 2 } /* rev 0: none */
typedef Beacon { bit there; byte term; Course course; Proposal next }
typedef Status { bit there; byte term; Course course; unsigned confirmed : 4; bit hears }

/* The coordinator. */
#define DEAD 0
#define LISTENS 1
#define LEADS 2
unsigned phase : 2 = DEAD;
unsigned life : 2 = 0;
byte term, highest;
Course c; /* what is flown; while it listens, the newest that was heard of */
unsigned last_rev : 4;
unsigned granted_age : 2;
Proposal next;
unsigned until_start : 3;
unsigned check_rev : 4; /* 0: nothing to check */
unsigned check_in : 3;
bit check_before;
bit asked;       /* for rest, and not answered */
typedef Member { bit known; unsigned heard : 2; unsigned hears : 2; unsigned rev : 4; unsigned confirmed : 4;
                 unsigned lease : 4; bit newest; bit ready }
Member member[2];

/* The agents, what is on its way to them, and from them. */
typedef Agent { byte term; Course course; unsigned confirmed : 4; bit hears }
Agent agent[2];
Beacon to[2];
Status from[2];
Beacon last_word; /* of the coordinator before this one */
unsigned last_word_age : 2;
Beacon now_sent; Status now_said;

/* What only the claims look at. */
unsigned commands : 2, changes : 3;
bit descending;       /* the second coordinator's nonce is the lower one, or the higher one */
bit told;             /* a person asked for rest, and was told "done" */
bit stopped[2];       /* by the end of a lease, and no person has engaged since */
bit all_stopped;      /* all of them were, at once */

#define MOVES(i) (agent[i].course.rev != 0 && agent[i].course.target == 1 && !IS_OVER(agent[i].course.lease))
#define NEWER(a, b) (a.term > b.term || (a.term == b.term && a.rev > b.rev))
#define SAME(a, b) (a.wish == b.wish && a.by == b.by && a.target == b.target)
#define IN_TOUCH(i) (member[i].known && member[i].heard <= TIMEOUT && member[i].hears <= TIMEOUT)
#define HEARD(i) (member[i].known && member[i].heard <= TIMEOUT)
#define RESTS (c.target == 0 || IS_OVER(c.lease))

inline copy(a, b) {
  a.term = b.term; a.rev = b.rev; a.wish = b.wish; a.by = b.by; a.target = b.target; a.lease = b.lease;
  a.newest = b.newest
}
inline forget(a) { a.term = 0; a.rev = 0; a.wish = 0; a.by = 0; a.target = 0; a.lease = 0; a.newest = 0 }
inline forget_beacon(b) {
  b.there = 0; b.term = 0; forget(b.course); b.next.rev = 0; b.next.wish = 0; b.next.by = 0
}
inline forget_status(s) { s.there = 0; s.term = 0; forget(s.course); s.confirmed = 0; s.hears = 0 }
inline forget_next() { next.rev = 0; next.wish = 0; next.by = 0; until_start = 0 }
inline forget_check() { check_rev = 0; check_in = 0; check_before = 0 }

/* ------------------------------------------------------------------------------------------------- coordinator */

inline die() {
  phase = DEAD; term = 0; highest = 0; forget(c); last_rev = 0; granted_age = 0;
  forget_next(); forget_check(); asked = 0;
  for (k : 0 .. 1) {
    member[k].known = 0; member[k].heard = 0; member[k].hears = 0; member[k].rev = 0; member[k].confirmed = 0;
    member[k].lease = 0; member[k].newest = 0; member[k].ready = 0
  }
  k = 0
}

/* Leading::change */
inline change() { last_rev++; c.term = term; c.rev = last_rev }

/* Leading::begin, schedule; without a rehearsal it is proposed at once */
inline begin(wished, whose) {
  if
  :: changes < CHANGES ->
     changes++;
     last_rev++; next.rev = last_rev;
     next.wish = wished; next.by = whose; until_start = LEAD
  :: else
  fi
}

/* Leading::Leading, next_term */
inline lead() {
#ifdef BREAK_NONCE
  term = 4 * (highest / 4 + 1);
#else
  term = 4 * (highest / 4 + 1) + (descending -> 3 - life : life);
#endif
  highest = 0;
  last_rev = c.rev;
#ifdef BREAK_WISH /* the wish is the process's, not the course's */
  c.wish = 0; c.by = NOBODY;
#endif
  change();
  c.newest = 0; granted_age = TIMEOUT + 1; nobody_confirms(0);
  phase = LEADS;
  for (k : 0 .. 1) { member[k].rev = 0; member[k].confirmed = 0 } /* said to somebody else */
  k = 0
}

/* Coordinator::on(AgentStatus), Fleet::take, Recovery::take */
inline take(i, s, overtaken) {
  if
  :: phase == DEAD || overtaken
  :: phase == LEADS && !overtaken && s.term > term -> die() /* stand_down */
  :: else ->
     if
     :: !member[i].known || s.hears -> member[i].hears = 0
     :: else
     fi;
     agent[i].hears = 0;
     member[i].known = 1; member[i].heard = 0;
     member[i].newest = (s.course.lease -> s.course.newest : member[i].newest);
     member[i].lease = (s.course.lease -> s.course.lease : member[i].lease);
     member[i].ready = (phase == LISTENS || c.by == NOBODY) && s.course.rev != 0 &&
                       (s.course.target == 0 || IS_OVER(s.course.lease));
     if
     :: phase == LEADS ->
        member[i].rev = (s.course.term == term -> s.course.rev : 0);
        member[i].confirmed = (s.term == term -> s.confirmed : 0)
     :: else ->
        highest = (s.term > highest -> s.term : highest);
        if
        :: s.course.rev == 0
        :: s.course.rev != 0 && (c.rev == 0 || NEWER(s.course, c)) -> copy(c, s.course)
        :: s.course.rev != 0 && c.rev != 0 && !NEWER(s.course, c) && !NEWER(c, s.course) && s.course.lease > c.lease ->
           c.lease = s.course.lease
        :: else
        fi
     fi
  fi
}

#ifdef BREAK_TURN /* a start that was turned back, and a lease that ended meanwhile: it is still wished */
#define TURNED_BACK_FLIES true
#else
#define TURNED_BACK_FLIES false
#endif

/* Leading::end_lease */
inline end_lease() {
#ifndef BREAK_CHECK /* a change that nobody has begun when the lease ends is turned back */
  if
  :: IS_OVER(c.lease) -> forget_check()
  :: else
  fi;
#endif
  if
  :: IS_OVER(c.lease) && (c.target == 1 || (c.wish == 1 && !TURNED_BACK_FLIES)) ->
     c.target = 0;
     if
     :: c.wish == 1 ->
        c.wish = 0;
#ifdef BREAK_SILENCE /* that a lease ended is nobody's wish */
        c.by = NOBODY
#else
        c.by = SILENCE
#endif
     :: else
     fi;
     change(); forget_next()
  :: else
  fi
}

#define CONFIRMED(i) (member[i].known && member[i].lease != 0)
#define LEAST2(a, b) ((a) < (b) -> (a) : (b))

/* By others than this coordinator the same moment may have been granted before. */
inline nobody_confirms(others) {
  for (k : 0 .. 1) {
    agent[k].course.newest = others && agent[k].course.term != term;
    to[k].course.newest = others && to[k].there && to[k].course.term != term;
    from[k].course.newest = others && from[k].there && from[k].course.term != term;
    member[k].newest = others && member[k].known && member[k].rev == 0
  }
}
inline grant(moment) { c.lease = moment; c.newest = 1; granted_age = 0; nobody_confirms(1) }

#ifdef BREAK_STEP /* as long as the silence before it */
#define STEP NEXT
#else
#define STEP REACH
#endif

/* LeaseBook::step */
inline step_lease() {
  least = NEXT + 1;
  for (k : 0 .. 1) { least = (CONFIRMED(k) -> LEAST2(least, member[k].lease) : least) }
  all = CONFIRMED(0) && IN_TOUCH(0) && CONFIRMED(1) && IN_TOUCH(1);
#ifdef BREAK_NEWEST /* a step that was taken back is granted once more, and words about the first one confirm it */
  all = all && least >= c.lease;
#else
  all = all && least >= c.lease && (!c.newest || (member[0].newest && member[1].newest));
#endif
  if
  :: all -> c.newest = 0; nobody_confirms(0)
  :: else
  fi;
  if
  :: c.lease == 0 -> grant(NEXT)
#ifdef BREAK_LEASE /* extended with every beacon, whoever has confirmed it */
  :: c.lease != 0 -> grant(NEXT)
#else
  :: c.lease != 0 && all ->
     if
     :: IS_OVER(c.lease) -> grant(NEXT)
     :: !IS_OVER(c.lease) && NEXT > c.lease && c.lease - 2 > PATIENCE + SPARE ->
        least = LEAST2(NEXT, c.lease + STEP);
        grant(least)
     :: else
     fi
  :: c.lease != 0 && !all ->
     if
     :: granted_age > PATIENCE && least > 2 -> c.lease = LEAST2(c.lease, least); c.newest = 0; nobody_confirms(0)
     :: else
     fi
#endif
  fi;
  least = 0; all = 0
}

/* Leading::check_start: turning back */
inline check_start() {
  if
  :: check_rev != 0 && c.rev != check_rev -> forget_check()
  :: check_rev != 0 && c.rev == check_rev && check_in == 0 && (HEARD(0) || HEARD(1)) ->
     if
     :: member[0].rev >= check_rev && member[1].rev >= check_rev
     :: else -> forget_next(); c.target = check_before; change()
     fi;
     forget_check()
  :: else
  fi
}

/* Leading::unconfirmed */
#define AGREES(i) (HEARD(i) && member[i].confirmed == next.rev && member[i].lease > LEAD + 2)

/* Leading::pursue, go, Agreement::step */
inline pursue() {
  if
#ifdef BREAK_GO /* one is enough */
  :: AGREES(0) || AGREES(1) ->
#else
  :: AGREES(0) && AGREES(1) ->
#endif
     /* Claim 2: go means that every agent has confirmed, by what the agents themselves know. */
     CLAIM(2, agent[0].term == term && agent[0].confirmed == next.rev);
     CLAIM(2, agent[1].term == term && agent[1].confirmed == next.rev);
     check_rev = next.rev; check_in = until_start + CHECK; check_before = c.target;
     c.rev = next.rev; c.wish = next.wish; c.by = next.by; c.target = next.wish;
     asked = c.by == PERSON && c.wish == 0;
     forget_next()
  :: else ->
     if
     :: until_start < MARGIN -> forget_next()
     :: else
     fi
  fi
}

/* Leading::drive, pending_wish, departure_is_due; started with --engage */
inline drive() {
  if
  :: !IN_TOUCH(0) || !IN_TOUCH(1)
  :: else ->
     if
     :: c.by == NOBODY && member[0].ready && member[1].ready -> begin(1, START)
     :: c.by != NOBODY && c.wish != c.target -> begin(c.wish, c.by)
     :: else
     fi
  fi
}

#define FOLLOWS(i) (member[i].known && member[i].rev >= c.rev)

/* CommandDesk::keep_promises, Leading::why_unsafe: of who is out of touch nothing is promised. */
inline keep_promises() {
  if
  :: asked && (c.wish == 1 || c.by != PERSON) -> asked = 0
#ifdef BREAK_DONE /* told as soon as it is granted */
  :: asked && c.wish == 0 && c.by == PERSON -> told = 1; asked = 0
#endif
  :: asked && c.wish == 0 && c.by == PERSON && FOLLOWS(0) && FOLLOWS(1) -> told = 1; asked = 0
  :: asked && c.wish == 0 && c.by == PERSON && FOLLOWS(0) != FOLLOWS(1) &&
       (FOLLOWS(0) || !IN_TOUCH(0)) && (FOLLOWS(1) || !IN_TOUCH(1)) ->
#ifdef CLAIM_SILENT
     told = 1;
#endif
     asked = 0
  :: else
  fi
}

/* Leading::tick */
inline tick() {
  keep_promises();
  end_lease();
  step_lease();
  check_start();
  if
  :: next.rev != 0 -> pursue()
  :: else -> drive()
  fi
}

/* Leading::command, command_obstacle: what is not obeyed changes nothing, and is not modelled. */
inline engage() {
  commands++;
  stopped[0] = 0; stopped[1] = 0; all_stopped = 0; told = 0; asked = 0;
  if
  :: c.target == 1 -> c.wish = 1; c.by = PERSON; change()
  :: else -> begin(1, PERSON)
  fi
}
inline rest() {
  commands++;
  forget_next();
  if
  :: RESTS || !IN_TOUCH(0) || !IN_TOUCH(1) ->
     if
     :: c.wish == 0 && c.by == PERSON
     :: else -> c.wish = 0; c.by = PERSON; change()
     fi;
     asked = 1
  :: else -> begin(0, PERSON)
  fi
}

/* ------------------------------------------------------------------------------------------------------ agents */

#ifdef BREAK_TERM /* whoever speaks is followed */
#define TERM_OF(i) 0
#else
#define TERM_OF(i) agent[i].term
#endif

/* Agent::on(Beacon), accepts_term, confirms, adopt */
inline hear(i, b, overtaken) {
  if
  :: overtaken || b.term < TERM_OF(i)
  :: else ->
     CLAIM(6, b.term >= agent[i].term); /* Claim 6 */
     if
     :: b.term > agent[i].term -> agent[i].confirmed = 0
     :: else
     fi;
     agent[i].term = b.term;
     agent[i].hears = 1;
     if
     :: b.next.rev != 0 && (b.term > agent[i].course.term || b.next.rev > agent[i].course.rev) ->
        agent[i].confirmed = b.next.rev
     :: else
     fi;
     if
     :: agent[i].course.rev == 0 || NEWER(b.course, agent[i].course) || !NEWER(agent[i].course, b.course) ->
        copy(agent[i].course, b.course)
     :: else
     fi;
     judge(i)
  fi
}

inline judge(i) {
  /* Claim 3: one number, one course. */
  CLAIM(3, agent[0].course.rev == 0 || agent[0].course.term != agent[1].course.term ||
         agent[0].course.rev != agent[1].course.rev || SAME(agent[0].course, agent[1].course));
  /* Claim 1: what a person stopped stays stopped. */
  CLAIM(1, !(told && agent[i].course.wish == 1));
  /* Claim 5: what a lease stopped stays stopped. */
  CLAIM(5, !(all_stopped && MOVES(i)));
#ifdef CLAIM_STOPPED_ALONE
  CLAIM(5, !(stopped[i] && MOVES(i)));
#endif
}

/* ------------------------------------------------------------------------------------------------------ network */

inline send_beacon(b) {
  b.there = 1; b.term = term; copy(b.course, c);
  b.next.rev = next.rev; b.next.wish = next.wish; b.next.by = next.by
}
inline send_status(i, s) {
  s.there = 1; s.term = agent[i].term; copy(s.course, agent[i].course);
  s.confirmed = agent[i].confirmed; s.hears = agent[i].hears
}

/* What was sent now is lost, or comes now, or in the next round; and what was sent in the round before comes before it
 * or, overtaken, after it. To be delayed and then lost is to be lost. */
inline beacon_to(i) {
  if
  :: to[i].there -> d_step { hear(i, to[i], false); forget_beacon(to[i]) }
  :: to[i].there && phase == LEADS ->
     d_step {
       send_beacon(now_sent); hear(i, now_sent, false); hear(i, to[i], true);
       forget_beacon(to[i]); forget_beacon(now_sent)
     };
     overtook = 1
  :: !to[i].there
  fi;
  if
  :: overtook -> overtook = 0
  :: !overtook && phase == LEADS -> d_step { send_beacon(now_sent); hear(i, now_sent, false); forget_beacon(now_sent) }
  :: !overtook && phase == LEADS && i < DELAYS -> d_step { send_beacon(to[i]) }
  :: !overtook
  fi
}
inline status_of(i) {
  if
  :: from[i].there -> d_step { take(i, from[i], false); forget_status(from[i]) }
  :: from[i].there ->
     d_step {
       send_status(i, now_said); take(i, now_said, false); take(i, from[i], true);
       forget_status(from[i]); forget_status(now_said)
     };
     overtook = 1
  :: !from[i].there
  fi;
  if
  :: overtook -> overtook = 0
  :: !overtook -> d_step { send_status(i, now_said); take(i, now_said, false); forget_status(now_said) }
  :: !overtook && i < DELAYS -> d_step { send_status(i, from[i]) }
  :: !overtook
  fi
}

/* --------------------------------------------------------------------------------------------------------- time */

#define PASS(lease) lease = ((lease) > OVER -> (lease) - 1 : (lease))
#define AGE(age) age = ((age) <= TIMEOUT -> (age) + 1 : (age))
#define DOWN(count) count = ((count) > 0 -> (count) - 1 : 0)

inline ends(i) {
  if
  :: agent[i].course.lease == 2 && MOVES(i) ->
     stopped[i] = 1;
     /* Claim 4: all stop at the same moment, or a step apart. */
     CLAIM(4, !MOVES(1 - i) || agent[1 - i].course.lease - 2 <= APART)
  :: else
  fi
}

/* Seen when spin replays a counterexample: one line for each round, as it ends. */
inline tell() {
  printf("life %d phase %d term %d  course %d wish %d/%d target %d lease %d  next %d", life, phase, term, c.rev,
         c.wish, c.by, c.target, c.lease, next.rev);
  printf("  | agent 0: term %d course %d.%d wish %d/%d target %d lease %d confirmed %d", agent[0].term,
         agent[0].course.term, agent[0].course.rev, agent[0].course.wish, agent[0].course.by, agent[0].course.target,
         agent[0].course.lease, agent[0].confirmed);
  printf("  | agent 1: term %d course %d.%d wish %d/%d target %d lease %d confirmed %d\n", agent[1].term,
         agent[1].course.term, agent[1].course.rev, agent[1].course.wish, agent[1].course.by, agent[1].course.target,
         agent[1].course.lease, agent[1].confirmed)
}

inline pass() {
  tell();
  if
  :: last_word.there && last_word_age < OLDEST -> last_word_age++
  :: else -> last_word_age = 0; forget_beacon(last_word)
  fi;
  ends(0); ends(1);
  PASS(c.lease); PASS(last_word.course.lease);
  for (k : 0 .. 1) {
    PASS(agent[k].course.lease); PASS(to[k].course.lease); PASS(from[k].course.lease); PASS(member[k].lease);
    AGE(member[k].heard); AGE(member[k].hears);
    member[k].heard = (member[k].known -> member[k].heard : 0);
    member[k].hears = (member[k].known -> member[k].hears : 0)
  }
  AGE(granted_age); granted_age = (phase == LEADS -> granted_age : 0);
  DOWN(until_start); DOWN(check_in);
  all_stopped = all_stopped || (stopped[0] && stopped[1] && !MOVES(0) && !MOVES(1));
  k = 0
}

/* -------------------------------------------------------------------------------------------------------- rounds */

init {
  byte k, least; bit all, overtook;
  if
  :: descending = 0
  :: LIVES > 2 -> descending = 1
  fi;
  do
  :: atomic {
       if
       :: phase == DEAD && life < LIVES -> d_step { life++; phase = LISTENS }
       :: phase == DEAD
       :: phase != DEAD && life < LIVES ->
          d_step {
            if
            :: phase == LEADS -> send_beacon(last_word); last_word_age = 0
            :: else
            fi;
            die()
          }
       :: phase == LISTENS && ((c.rev != 0 && (member[0].known || member[1].known)) ||
                               (member[0].known && member[1].known)) -> d_step { lead(); tick(); k = 0 }
       :: phase == LISTENS
       :: phase == LEADS -> d_step { tick(); k = 0 }
       :: phase == LEADS && commands < COMMANDS && !(c.wish == 0 && c.by != NOBODY && c.target == 0) ->
          d_step { rest(); tick(); k = 0 }
       :: phase == LEADS && commands < COMMANDS && next.rev == 0 && !(c.wish == 1 && c.target == 1) &&
            (c.target == 1 || (IN_TOUCH(0) && IN_TOUCH(1))) ->
          d_step { engage(); tick(); k = 0 }
       fi
     };
     atomic {
       beacon_to(0); beacon_to(1);
       /* the last word of a coordinator that is gone may still come */
       if
       :: last_word.there -> d_step { hear(0, last_word, false); forget_beacon(last_word) }
       :: last_word.there -> d_step { hear(1, last_word, false); forget_beacon(last_word) }
       :: true
       fi
     };
     atomic {
       status_of(0); status_of(1);
       if
       :: d_step { pass() }
#ifdef HASTE /* what is said once in a round may be said several times: a lease that is behind is extended so */
       :: phase == LEADS && c.lease > OVER && c.lease < NEXT
#endif
       fi
     }
  od
}
