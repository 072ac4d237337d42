// What the data are decides which page it is.
import { comparePage } from './compare_page';
import { load, type ComparisonData, type MatrixData, type RunData, type StudyData } from './data';
import { h } from './dom';
import { livePage } from './live_page';
import { matrixPage } from './matrix_page';
import { runPage } from './run_page';
import { studyPage } from './study_page';
import './style.css';

async function start(): Promise<void> {
  try {
    const data = JSON.parse(document.getElementById('data')!.textContent!) as RunData | ComparisonData | MatrixData | StudyData | { live: string };
    if ('comparison' in data) comparePage(data, await load(data.runs[0]), await load(data.runs[1]));
    else if ('cells' in data) matrixPage(data);
    else if ('study' in data) studyPage(data);
    else if ('live' in data) livePage(data.live);
    else runPage(await load(data));
  } catch (error) {
    document.getElementById('page')!.append(h('p', { class: 'note' }, `This page cannot be shown: ${String(error)}`));
    throw error;
  }
}

void start();
