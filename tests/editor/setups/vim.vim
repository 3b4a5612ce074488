" What `editors/vim` brings to Vim: run in examples/pocket by `scripts/check-editors`. What was seen stands in `seen`.
edit part.cls
17substitute/1200/12O0/
write
silent make
let s:first = get(getqflist(), 0, {})
let s:color = synIDattr(synID(search('^GOTO'), 1, 1), 'name')
call writefile([&filetype, s:color, string(s:first)], 'seen')
if &filetype ==# 'clsf' && s:color ==# 'clMotion' && get(s:first, 'lnum') == 17 && get(s:first, 'col') == 13
  qall!
endif
cquit
