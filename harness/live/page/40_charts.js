// The charts: update times, errors, NEES.

const charts = { all: [], drawn: 0, isStale: false };
const mostChartPoints = 2000;
const msBetweenCharts = 300;

function takeHistory(points, i, isWhole) {
  const belief = state.beliefs[i];
  if (!belief || !points) return;
  if (isWhole) belief.history = [];
  for (let k = 0; k + 4 < points.length; k += 5) belief.history.push(points.slice(k, k + 5));
  if (belief.history.length > mostChartPoints) belief.history = belief.history.filter((_, k) => k % 2 === 0);
  charts.isStale = true;
}

on("history", ({ arrays }) => state.beliefs.forEach((_, i) => takeHistory(arrays[`h${i}`], i, true)));
on("frame", ({ arrays }) => state.beliefs.forEach((_, i) => takeHistory(arrays[`h${i}`], i, false)));

function makeChart(id, isLogarithmic) {
  const ink = getComputedStyle(document.body).getPropertyValue("--faint");
  const rule = getComputedStyle(document.body).getPropertyValue("--rule");
  const axis = { ticks: { color: ink, maxTicksLimit: 6 }, grid: { color: rule } };
  return new Chart(byId(id), {
    type: "line",
    data: { datasets: [] },
    options: {
      animation: false, parsing: false, normalized: true, maintainAspectRatio: false, events: [],
      plugins: { legend: { display: false } },
      scales: { x: { type: "linear", ...axis }, y: { type: isLogarithmic ? "logarithmic" : "linear", ...axis } },
    },
  });
}

function curve(i, column, dash) {
  const points = [];
  for (const row of state.beliefs[i].history) if (!Number.isNaN(row[column])) points.push({ x: row[0], y: row[column] });
  return { data: points, borderColor: state.hello.estimators[i].colour, borderWidth: 1.5, borderDash: dash, pointRadius: 0 };
}

function refreshCharts(now) {
  if (!byId("charts-part").open || !charts.isStale || now - charts.drawn < msBetweenCharts) return;
  if (charts.all.length === 0) charts.all = [makeChart("chart-time", true), makeChart("chart-error", false), makeChart("chart-nees", true)];
  charts.drawn = now;
  charts.isStale = false;
  const shown = state.beliefs.map((_, i) => i).filter((i) => state.shown[i]);
  const sets = [shown.map((i) => curve(i, 1, [])),
    shown.flatMap((i) => [curve(i, 2, []), curve(i, 3, [5, 4])]),
    shown.map((i) => curve(i, 4, []))];
  charts.all.forEach((chart, k) => { chart.data.datasets = sets[k]; chart.update("none"); });
}

byId("charts-part").addEventListener("toggle", () => { charts.isStale = true; });
