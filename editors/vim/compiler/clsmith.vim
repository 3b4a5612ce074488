" `:make` checks the program; its findings stand in the quickfix list.
if exists("current_compiler") | finish | endif
let current_compiler = "clsmith"
CompilerSet makeprg=clsmith\ check\ --format\ line\ %:S
CompilerSet errorformat=%f:%l:%c:\ %m
