// One page with everything in it: `zwang report` puts the run's data into its midst.
import { createHash } from 'node:crypto';
import { defineConfig } from 'vite';

const sha256 = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

// Script and style move into the page, which then allows these two and nothing else: no network, no other script.
const onePage = {
  name: 'one-page',
  enforce: 'post',
  generateBundle(_, bundle) {
    const files = Object.values(bundle);
    const page = files.find((file) => file.fileName.endsWith('.html'));
    const script = files.find((file) => file.type === 'chunk' && file.isEntry).code.replaceAll('</script', '<\\/script');
    const style = files.find((file) => file.fileName.endsWith('.css')).source.toString();
    const policy = `default-src 'none'; script-src ${sha256(script)}; style-src ${sha256(style)}; img-src data:; ` +
      `base-uri 'none'; form-action 'none'`;
    const html = page.source
      .replace(/<script[^>]*type="module"[^>]*><\/script>\s*/g, '')
      .replace(/<link[^>]*rel="stylesheet"[^>]*>\s*/g, '');
    page.source = html
      .replace('</head>', () => `<meta http-equiv="Content-Security-Policy" content="${policy}">\n<style>${style}</style>\n</head>`)
      .replace('</body>', () => `<script type="module">${script}</script>\n</body>`);
    page.fileName = 'report.html';
    for (const [name, file] of Object.entries(bundle)) {
      if (file !== page) delete bundle[name];
    }
  },
};

export default defineConfig({
  plugins: [onePage],
  build: {
    target: 'es2022',
    modulePreload: false,
    cssCodeSplit: false,
    chunkSizeWarningLimit: 2000,
    rollupOptions: { output: { inlineDynamicImports: true } },
  },
});
