// Fixed names: the program embeds these files by name. No source map: what is committed stays small.
//
// `npm run dev` serves the page as it is being written, and hands the interface on to a program that runs at KINETWIN
// (http://127.0.0.1:8100 unless set).
const program = process.env.KINETWIN ?? "http://127.0.0.1:8100";
const proxy = {
  "/api": { target: program, changeOrigin: true, ws: true, headers: { origin: program, "sec-fetch-site": "same-origin" } },
};

export default {
  base: "./",
  server: { proxy },
  preview: { proxy },
  build: {
    outDir: "dist",
    target: "es2022",
    sourcemap: false,
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1500,
    modulePreload: { polyfill: false },
    rollupOptions: {
      output: {
        entryFileNames: "assets/app.js",
        chunkFileNames: "assets/[name].js",
        assetFileNames: "assets/app[extname]",
        inlineDynamicImports: true,
      },
    },
  },
};
