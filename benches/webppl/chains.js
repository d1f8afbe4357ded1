// Markov chains on one WebPPL program; prints one JSON line, the same that the limit prints.
//   node chains.js WEBPPL_FOLDER hmm|lda|gmm|hlr DATA.json MH|incrementalMH SECONDS SEED
// Seconds are CPU seconds of this process. The clock starts at the first state: neither compilation nor the first
// run count. Naming 'incrementalMH' in a program switches its caching on for all of it, so each method has a program
// of its own; `onlyMAP` and the lag keep samples from being copied.
'use strict';
var fs = require('fs');
var path = require('path');
var [folder, program, data, method, seconds, seed] = process.argv.slice(2);
folder = path.resolve(folder);
var webppl = require(path.join(folder, 'src/main'));
require(path.join(folder, 'src/util')).seedRNG(+seed);
global.data = JSON.parse(fs.readFileSync(data, 'utf8'));

// Proposals between two looks at the clock, and the fewest that make a rate.
var CHUNK = 100, LEAST = 1000;

function cpuSeconds() {
  var usage = process.cpuUsage();
  return (usage.user + usage.system) / 1e6;
}

var start = null, proposals = 0, first = null, fastest = [], mark = 0;

function begin() { start = mark = cpuSeconds(); proposals = 0; }

function tell(count) {
  var now = cpuSeconds();
  proposals += count;
  fastest.push(count / Math.max(now - mark, 1e-6));
  mark = now;
  if (first === null && proposals >= LEAST) first = proposals / (now - start);
  if (proposals < LEAST || now - start < +seconds) return;
  fastest.sort(function(a, b) { return a - b; });
  console.log(JSON.stringify({
    proposals: proposals, cpu_seconds: now - start, first: first,
    fastest: fastest[Math.floor(0.9 * (fastest.length - 1))]
  }));
  process.exit(0);
}

// MH tells of each iteration, incrementalMH of its first state and then of every CHUNK-th.
var running = false;
global.bench = {
  samples: 1e9, lag: CHUNK - 1,
  each: method === 'MH' ? {
    iteration: function() { if (start === null) begin(); },
    sample: function() { tell(running ? CHUNK : CHUNK - 1); running = true; }
  } : { sample: function() { if (start === null) begin(); else tell(CHUNK); } }
};

var how = method === 'MH' ? "method: 'MCMC', kernel: 'MH'" : "method: 'incrementalMH'";
var source = fs.readFileSync(path.join(__dirname, 'chains', program + '.wppl'), 'utf8') +
    '\nInfer({model: model, ' + how + ', samples: bench.samples, lag: bench.lag, onlyMAP: true, ' +
    'callbacks: [bench.each]});';
webppl.prepare(webppl.compile(source, { filename: program + '.wppl' }), function() { return null; }).run();
