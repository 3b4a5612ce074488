" CL programs by their ends. `.cls` is also the end of LaTeX classes: a LaTeX class says so in its first lines.
autocmd BufNewFile,BufRead *.clsf,*.ncl,*.apt,*.aptsource set filetype=clsf
autocmd BufNewFile,BufRead *.cls if join(getline(1, 20)) !~# '\\NeedsTeXFormat\|\\ProvidesClass' | set filetype=clsf | endif
